rule tables:
    input:
        sheets=expand(rules.sheet.output, shard=SHARDS),
        surfaces=expand(rules.extract.output.surfaces, shard=SHARDS),
        branches=expand(rules.extract.output.branches, shard=SHARDS),
    output:
        surfaces=results / "surfaces.csv",
        branches=results / "branches.csv",
    script:
        "../scripts/merge.py"
