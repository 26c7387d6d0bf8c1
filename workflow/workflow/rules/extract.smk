def sheet_of_shard(shard):
    first = int(shard) * config["shard_size"]
    return surfaces.iloc[first:first + config["shard_size"]]


# The shard's part of the sheet, with absolute paths: a job on another machine needs no more.
rule sheet:
    output:
        results / "sheets" / "{shard}.tsv",
    run:
        part = sheet_of_shard(wildcards.shard).copy()
        part["path"] = [str((sheet.parent / path).resolve()) for path in part["path"]]
        if "options" not in part:
            part["options"] = ""
        part[["id", "path", "options"]].to_csv(output[0], index=False, sep="\t", quoting=3)


# Everything of one surface lies in a folder of its own shard until the shard is done. A surface
# that has a status is not extracted again: a job that was killed goes on where it stood.
rule extract:
    input:
        rules.sheet.output,
    output:
        surfaces=results / "shards" / "{shard}.surfaces.csv",
        branches=results / "shards" / "{shard}.branches.csv",
        seconds=results / "shards" / "{shard}.seconds.csv",
    params:
        work=lambda wildcards: results / "work" / wildcards.shard,
        program=config["program"],
        time_limit=config["time_limit"],
        one=workflow.source_path("../scripts/extract_one.sh"),
        rows=workflow.source_path("../scripts/rows.py"),
    threads: workflow.cores if workflow.cores else 1
    resources:
        mem_mb=lambda wildcards, threads: 1000 * threads,
        runtime=240,
    shell:
        "mkdir -p {params.work} && "
        "tail -n +2 {input} | "
        "parallel --jobs {threads} --colsep '\\t' --halt never --plain "
        "sh {params.one} {params.program} {params.work} {params.time_limit} {{1}} {{2}} {{3}} && "
        "python3 {params.rows} {input} {params.work} {output.surfaces} {output.branches} "
        "{output.seconds}"
