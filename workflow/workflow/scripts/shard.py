"""The rows of a shard with absolute paths, separated by tabs, which no path has."""

import pathlib

import pandas

sheet = pathlib.Path(snakemake.params.sheet)
first = snakemake.params.first
part = pandas.read_csv(sheet, dtype=str, keep_default_na=False)
part = part.iloc[first:first + snakemake.params.size].copy()
part["path"] = [str((sheet.parent / path).resolve()) for path in part["path"]]
if "options" not in part:
    part["options"] = ""
part[["id", "path", "options"]].to_csv(snakemake.output[0], index=False, sep="\t", quoting=3)
