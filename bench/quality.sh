#!/usr/bin/env bash
# usage: bench/quality.sh BUILD_DIR
# Makes docs/quality.md and its pictures anew: this program beside CGAL's mean curvature flow
# skeletonization on every closed surface of ../shared/meshes, and the effect of small changes on the
# skeletons of both. Ten minutes on an idle machine.
set -euo pipefail
build=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
meshes=../shared/meshes
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The table lies where its links start from.
"$build/bin/compare_cgal" --meshes "$meshes" --markdown docs/quality-table.md.new \
  --pictures docs/pictures/quality --csv "$work/quality.csv" >&2
mv docs/quality-table.md.new "$work/table.md"
mapfile -t files < <(cut -d, -f1 "$work/quality.csv" | tail -n +2 | sort -u)
paths=()
for file in "${files[@]}"; do
  case $file in
    *200k*) ;;  # the same shape as scorpion-6k
    *) paths+=("$(find "$meshes" -name "$file" -not -path '*/defects/*')") ;;
  esac
done
"$build/bin/surgeries" "${paths[@]}" >"$work/surgeries.md"
"$build/bin/stability" "${paths[@]}" >"$work/stability.md"
"$build/bin/stability" --cgal "${paths[@]}" >"$work/stability-cgal.md"
"$build/bin/stability" --noise "${paths[@]}" >"$work/noise.md"
"$build/bin/stability" --noise --cgal "${paths[@]}" >"$work/noise-cgal.md"

python3 - "$work/quality.csv" >"$work/summary.md" <<'PYTHON'
import csv, sys
rows = list(csv.DictReader(open(sys.argv[1])))
ours = {r["file"]: r for r in rows if r["program"] == "curveskel"}
peer = {r["file"]: r for r in rows if r["program"] == "CGAL"}
both = [f for f in ours if f in peer]
print("| mean over", len(both), "surfaces | curveskel | CGAL | better, worse on |\n|---|---|---|---|")
for column, name, sign in (("coverage", "coverage", 1), ("centredness_median", "centredness, median", -1),
                           ("common_centredness", "the same where both run", -1),
                           ("reach", "reach / D", -1), ("total_curvature", "total curvature per D", -1),
                           ("inside_fraction", "inside", 1), ("spurs", "spurs", -1)):
    a = [float(ours[f][column]) for f in both]
    b = [float(peer[f][column]) for f in both]
    better = sum(sign * x > sign * y for x, y in zip(a, b))
    worse = sum(sign * x < sign * y for x, y in zip(a, b))
    finite = [y for y in b if y < 1e300]
    print(f"| {name} | {sum(a) / len(a):.4f} | {sum(finite) / len(finite):.4f} | {better}, {worse} |")
seconds = [sum(float(t[f]["seconds"]) for f in both) for t in (ours, peer)]
print(f"| seconds in all | {seconds[0]:.1f} | {seconds[1]:.1f} | {seconds[1] / seconds[0]:.1f} times as fast |")
PYTHON

{
  sed '/<!-- tables -->/q' docs/quality.md
  echo
  cat "$work/summary.md"
  echo
  cat "$work/table.md"
  printf '\n## Two surgeries\n'
  cat <<'TEXT'
The same contraction of each surface, handed to the surgery of this program and to CGAL's (`--surgery cgal`), with the embedding and without (`--embed none`); no second tries, no wraps. *Cut*: 1st = the first contraction did, 2nd = a gentler one, level sets = neither, so that level sets cut the surface; CGAL alone has one contraction and no level sets. Components and cycles: of the skeleton / of the surface. Seconds of the extraction without reading and repair. Without the embedding the curve is where the contracted vertices are: nothing keeps it inside, and spurs stay.

TEXT
  cat "$work/surgeries.md"
  printf '\n## Small changes\n'
  cat <<'TEXT'
Tips and junctions after a small change of the surface, and the Hausdorff distance of the skeletons over *D*. Most differences are one short, blunt branch whose prominence lies near the limit, a branch that the surgery did not make, or two junctions that become one.

TEXT
  cat "$work/stability.md"
  printf '\nCGAL, on the same surfaces: %s\n' "$(tail -1 "$work/stability-cgal.md" | sed 's/^S/s/')"
  printf '\nThe same counts, of %s surfaces each, as the noise grows; this program, then CGAL:\n\n' \
    "${#paths[@]}"
  cat "$work/noise.md"
  sed -n '3,$s/^|/| CGAL,/p' "$work/noise-cgal.md"
} >"$work/quality.md"
mv "$work/quality.md" docs/quality.md
