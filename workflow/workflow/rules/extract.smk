# Scripts have another temporary name at each start, which as parameters would make all anew.
EXTRACT_ONE = workflow.source_path("../scripts/extract_one.sh")
ROWS = workflow.source_path("../scripts/rows.py")


def state_of_shard(shard):
    """A digest of the shard's part of the sheet and of the dates and sizes of its files."""
    first = int(shard) * config["shard_size"]
    part = surfaces.iloc[first:first + config["shard_size"]]
    digest = hashlib.sha256()
    for row in part.to_dict("records"):
        path = (sheet.parent / row["path"]).resolve()
        try:
            found = os.stat(path)
            state = (found.st_mtime_ns, found.st_size)
        except OSError:
            state = None
        digest.update(repr((row["id"], str(path), row.get("options", ""), state)).encode())
    return digest.hexdigest()


# The shard's part of the sheet, with absolute paths: a job on another machine needs no more. It is
# written anew when a row or a file of it changes, and the shard with it.
rule sheet:
    output:
        results / "sheets" / "{shard}.tsv",
    params:
        sheet=str(sheet),
        first=lambda wildcards: int(wildcards.shard) * config["shard_size"],
        size=config["shard_size"],
        state=lambda wildcards: state_of_shard(wildcards.shard),
    script:
        "../scripts/shard.py"


# Everything of one surface lies in a folder of its own, work/SHARD/ID. A surface whose result is
# still that of its file and options is not extracted again: a job that was killed goes on where it
# stood. Those that were killed alone have a second try, with the job's memory to themselves.
rule extract:
    input:
        rules.sheet.output,
    output:
        surfaces=results / "shards" / "{shard}.surfaces.csv",
        branches=results / "shards" / "{shard}.branches.csv",
        seconds=results / "shards" / "{shard}.seconds.csv",
    params:
        work=lambda wildcards: str(results / "work" / wildcards.shard),
        program=config["program"],
        version=VERSION,
        time_limit=config["time_limit"],
    threads: workflow.cores if workflow.cores else 1
    resources:
        mem_mb=lambda wildcards, threads: 1000 * threads,
        runtime=240,
    shell:
        "each() {{ parallel --quote --jobs $1 --colsep '\\t' --trim n --halt never --plain "
        "sh {EXTRACT_ONE:q} {params.program:q} {params.version:q} {params.work:q} "
        "{params.time_limit} $2 {{1}} {{2}} {{3}}; }}\n"
        "left() {{ while IFS= read -r row; do "
        "[ -e {params.work:q}/\"${{row%%$'\\t'*}}\"/status ] || printf '%s\\n' \"$row\"; done; }}\n"
        "mkdir -p {params.work:q} && tail -n +2 {input:q} | each {threads} first && "
        "tail -n +2 {input:q} | left | each 1 last && "
        "python3 {ROWS:q} {input:q} {params.work:q} {output.surfaces:q} {output.branches:q} "
        "{output.seconds:q}"
