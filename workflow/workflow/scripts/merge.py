"""The shards' tables as one each, and as Parquet where pandas can write it."""

import csv
import shutil

import pandas


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


merge(snakemake.input.surfaces, snakemake.output.surfaces)
merge(snakemake.input.branches, snakemake.output.branches)
