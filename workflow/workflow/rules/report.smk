rule report:
    input:
        surfaces=rules.tables.output.surfaces,
        seconds=expand(rules.extract.output.seconds, shard=SHARDS),
    output:
        results / "report.html",
    params:
        program=config["program"],
        worst=config["worst"],
        time_limit=config["time_limit"],
    script:
        "../scripts/report.py"
