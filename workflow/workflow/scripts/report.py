"""One page about all surfaces: what became of them, histograms, the worst certificates."""

import html
import pathlib
import subprocess
import tempfile

import numpy
import pandas

MEANINGS = {0: "done", 1: "a defect of the program", 2: "usage",
            3: "no such file, or no surface in it that can be repaired", 4: "no device",
            5: "the certificate failed, or the time limit was reached", 6: "could not be written"}
HISTOGRAMS = {"vertices": True, "branches": True, "tips": True, "inside_fraction": False,
              "coverage": False, "centredness_median": False, "tube_share": False, "seconds": True}


def histogram(values, title, logarithmic):
    """Bars as SVG. A logarithmic scale has no place for 0, which the caption counts."""
    values = pandas.to_numeric(values, errors="coerce").dropna().to_numpy()
    if len(values) == 0:
        return ""
    logarithmic = logarithmic and (values > 0).any()
    drawn = values[values > 0] if logarithmic else values
    scaled = numpy.log10(drawn) if logarithmic else drawn
    counts, edges = numpy.histogram(scaled, bins=24)
    width, height, top = 320, 150, max(counts.max(), 1)
    bars = "".join(
        f'<rect x="{30 + k * 280 / 24:.1f}" y="{120 - 100 * count / top:.1f}" '
        f'width="{280 / 24 - 1:.1f}" height="{100 * count / top:.1f}"/>'
        for k, count in enumerate(counts))
    show = [10 ** edges[0] if logarithmic else edges[0], 10 ** edges[-1] if logarithmic else edges[-1]]
    words = title.replace("_", " ") + (", log scale" if logarithmic else "")
    if len(drawn) < len(values):
        words += f", {len(values) - len(drawn)} of 0 beside it"
    return (f'<figure><svg viewBox="0 0 {width} {height}">{bars}'
            f'<text x="30" y="134">{show[0]:.3g}</text>'
            f'<text x="310" y="134" text-anchor="end">{show[1]:.3g}</text>'
            f'<text x="26" y="24" text-anchor="end">{top}</text></svg>'
            f"<figcaption>{html.escape(words)}; median {numpy.median(values):.4g}</figcaption></figure>")


def picture(row, program, limit):
    """The skeleton in its surface, as SVG; nothing where that fails."""
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / "picture.svg"
        finest = pathlib.Path(folder) / "picture.1.svg"  # of several --levels
        subprocess.run([program, "extract", row["path"], "-o", output, "--quiet", "--time-limit",
                        str(limit), *str(row["options"]).split()], check=False,
                       capture_output=True)
        found = next((file for file in (output, finest) if file.exists()), None)
        if found is None:
            return ""
        text = found.read_text()
        return text[text.index("<svg"):]


def worst_first(surfaces):
    """Of those with a skeleton: topology, then what lies outside, then the least made of tubes."""
    there = surfaces[surfaces["inside_fraction"] != ""].copy()
    for column in ("inside_fraction", "tube_share"):
        there[column] = pandas.to_numeric(there[column])
    there["wrong"] = there["topology_correct"].astype(str).str.lower() != "true"
    return there.sort_values(["wrong", "inside_fraction", "tube_share"],
                             ascending=[False, True, True], kind="stable")


def meaning(status):
    return MEANINGS.get(status, f"killed by signal {status - 128}" if status > 128 else "")


def page(surfaces, program, worst, limit):
    counts = surfaces["status"].astype(int).value_counts().sort_index()
    outcomes = "".join(f"<tr><td>{status}</td><td>{meaning(status)}</td><td>{count}</td></tr>"
                       for status, count in counts.items())
    charts = "".join(histogram(surfaces[name], name, logarithmic)
                     for name, logarithmic in HISTOGRAMS.items())
    failures = "".join(
        f"<tr><td>{html.escape(row.id)}</td><td>{row.status}</td><td>{html.escape(row.message)}</td></tr>"
        for row in surfaces[surfaces["status"] != "0"].head(200).itertuples())
    pictures = "".join(
        f"<figure>{picture(row, program, limit)}<figcaption>{html.escape(row['id'])}: "
        f"{100 * row['inside_fraction']:.2f} % inside, {100 * row['tube_share']:.0f} % tubes"
        f"</figcaption></figure>" for _, row in worst_first(surfaces).head(worst).iterrows())
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Curve skeletons of {len(surfaces)} surfaces</title>
<style>
body {{ font: 14px/1.45 system-ui, sans-serif; margin: 20px; color: #23262b; background: #fbfaf7; }}
.grid {{ display: grid; grid-template-columns: repeat(auto-fill, minmax(300px, 1fr)); gap: 12px; }}
figure {{ margin: 0; background: #fff; border: 1px solid #e2e0da; border-radius: 8px; padding: 8px; }}
figure svg {{ width: 100%; height: auto; }} rect {{ fill: #4a7ebb; }} svg text {{ font-size: 11px; }}
figcaption {{ color: #6b7078; }} td {{ padding: 2px 10px; vertical-align: top; }}
</style></head><body>
<h1>Curve skeletons of {len(surfaces)} surfaces</h1>
<h2>What became of them</h2><table>{outcomes}</table>
<h2>Numbers</h2><div class="grid">{charts}</div>
<h2>The worst certificates</h2><div class="grid">{pictures}</div>
<h2>Failures</h2><table>{failures}</table>
</body></html>
"""


def main():
    surfaces = pandas.read_csv(snakemake.input.surfaces, dtype=str, keep_default_na=False)
    seconds = pandas.concat(pandas.read_csv(part, dtype=str, keep_default_na=False)
                            for part in snakemake.input.seconds)
    surfaces = surfaces.merge(seconds, on="id", how="left")
    pathlib.Path(snakemake.output[0]).write_text(
        page(surfaces, snakemake.params.program, snakemake.params.worst,
             snakemake.params.time_limit))


main()
