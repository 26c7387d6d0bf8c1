"""The shards' tables as one each, and as Parquet where pandas can write it."""

import csv
import shutil

import pandas


def ids_of(path, **dialect):
    with open(path, newline="") as file:
        return [row["id"] for row in csv.DictReader(file, **dialect)]


def require_same_ids(sheets, parts):
    """The shards' rows are those of the sheet, each once and in its order."""
    for sheet, part in zip(sheets, parts, strict=True):
        needed = ids_of(sheet, delimiter="\t", quoting=csv.QUOTE_NONE)
        found = ids_of(part)
        if found != needed:
            odd = sorted(set(found) ^ set(needed)) or ["none"]
            raise SystemExit(
                f"{part}: found {len(found)} rows, needed the {len(needed)} of {sheet} "
                f"(there in one of the two only: {odd[0]}); remove {part} and start again")


def merge(parts, output):
    columns = []
    for part in parts:
        with open(part, newline="") as file:
            header = next(csv.reader(file))
        columns = max(columns, header, key=len)
    with open(output, "w", newline="") as out:
        out.write(",".join(columns) + "\n")
        for part in parts:
            with open(part, newline="") as file:
                next(file)
                shutil.copyfileobj(file, out)
    try:
        import pyarrow  # noqa: F401
    except ImportError:
        return
    pandas.read_csv(output).to_parquet(str(output).removesuffix(".csv") + ".parquet")


require_same_ids(snakemake.input.sheets, snakemake.input.surfaces)
merge(snakemake.input.surfaces, snakemake.output.surfaces)
merge(snakemake.input.branches, snakemake.output.branches)
