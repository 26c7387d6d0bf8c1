"""Skeleton as Curves."""

import bpy
from scene import select, world_places, y_shape

body = y_shape()
select(body)
assert bpy.ops.curveskel.skeleton() == {"FINISHED"}
curve = next(thing for thing in bpy.data.objects if thing.type == "CURVE")
assert len(curve.data.splines) == 3, len(curve.data.splines)
places = world_places(body)
for spline in curve.data.splines:
    for point in spline.points:
        assert point.radius > 0
        nearest = min((place - point.co.to_3d()).length for place in places)
        assert 0.5 * point.radius < nearest < 3 * point.radius + 0.2, (nearest, point.radius)
