#!/usr/bin/env bash
# usage: docs/pictures.sh [SECONDS]
# Makes the viewer's pictures in docs/pictures. Run ./run first: it builds, and fetches the models.
# SECONDS: until the run in the window is done and its messages are gone. Needs xvfb, xdotool,
# imagemagick.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=build/release/bin/curveskel
model=meshes/real/camel.off
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Five moments side by side.
for stage in input contraction:3 surgery skeleton rig; do
  "$program" view "$model" --screenshot "$work/$stage.png" --size 340x306 --stage "$stage" 2>/dev/null
done
convert "$work"/{input,contraction:3,surgery,skeleton,rig}.png +append docs/pictures/viewer-stages.png

# README's, where the collection of meshes is.
armadillo=../shared/meshes/armadillo-43k.ply
if [ -e "$armadillo" ]; then
  "$program" view "$armadillo" --screenshot docs/pictures/armadillo.png --size 1300x760 \
    --two-sides 2>/dev/null
  "$program" view "$armadillo" --screenshot "$work/all.png" --size 640x560 --stage rig 2>/dev/null
  "$program" view ../shared/meshes/rigs/makehuman-body-13k-quads.obj --screenshot "$work/other.png" \
    --size 640x560 --stage rig 2>/dev/null
  convert "$work"/{all,other}.png +append docs/pictures/rig.png
  # The default beside the paper's chain.
  for preset in default paper; do
    "$program" view "$armadillo" --preset "$preset" --screenshot "$work/$preset.png" \
      --size 640x560 2>/dev/null
  done
  convert "$work"/{default,paper}.png +append docs/pictures/paper-preset.png
fi

# A rig, where the collection of meshes is: the weights of all joints, and those of one.
rig=../shared/meshes/rigs/quaternius-horse-1k.glb
if [ -e "$rig" ]; then
  "$program" view "$rig" --screenshot "$work/all.png" --size 640x520 2>/dev/null
  "$program" view "$rig" --screenshot "$work/one.png" --size 640x520 \
    --surface opaque --joint Neck1 2>/dev/null
  convert "$work"/{all,one}.png +append docs/pictures/viewer-rig.png
fi

# A character as its file has it and by role, at rest and turned by hand.
character=../shared/meshes/real/quaternius-Adventurer.glb
if [ -e "$character" ]; then
  turned=(--turn upper_arm.L:0,0,-60 --turn lower_arm.L:0,-70,0 --turn upper_leg.R:-60,0,0
    --turn lower_leg.R:60,0,0 --turn head:0,30,0)
  common=(--stage rig --surface opaque --size 440x520)
  "$program" view "$character" "${common[@]}" --screenshot "$work/a.png" 2>/dev/null
  "$program" view "$character" "${common[@]}" --colour role --screenshot "$work/b.png" 2>/dev/null
  "$program" view "$character" "${common[@]}" --no-bones "${turned[@]}" \
    --screenshot "$work/c.png" 2>/dev/null
  convert "$work"/{a,b,c}.png +append docs/pictures/viewer-pose.png
fi

# The window itself needs a display; a virtual one will do.
Xvfb :98 -screen 0 1280x800x24 &
display=$!
trap 'kill "$display"; rm -rf "$work"' EXIT
sleep 1
export DISPLAY=:98 XDG_STATE_HOME=$work
"$program" view "$model" --size 1280x800 &
viewer=$!
sleep "${1:-15}"
xdotool mousemove 640 2
sleep 2
import -window root docs/pictures/viewer-window.png
kill "$viewer"
wait "$viewer" || true
