"""Bones lie along their limbs, whatever the names."""

import bpy
from scene import far, figure, rig, run_laws
from curveskel_addon import armatures as module


def joint(name, parent, position, **more):
    return {"name": name, "parent": parent, "position": position, **more}


def tail_of(joints, number):
    place, target = module.tails(joints)[number]
    return [round(c, 4) for c in place], target


def bones_lie_on_their_axes():
    up, left = [0, 0, 1], [1, 0, 0]
    chest = [joint("joint_001", -1, [0, 0, 1], axis=up), joint("a", 0, [1, 0, 1], axis=left),
             joint("b", 1, [3, 0, 1], axis=left, end=True), joint("c", 0, [0, 0, 2], axis=up),
             joint("d", 0, [-1, 0, 1], axis=[-1, 0, 0])]
    assert tail_of(chest, 0) == ([0, 0, 2], 3)
    assert tail_of(chest, 1) == ([3, 0, 1], 2)
    assert tail_of(chest, 4) == ([-1.5, 0, 1], None)  # straight on
    assert [module.is_end(chest, n) for n in range(5)] == [False, False, True, False, False]
    chest[3]["position"] = [0.1, 0, 2]  # no longer on the axis: no child is met
    assert tail_of(chest, 0) == ([0, 0, 1 + round((2 + 1.01 ** 0.5) / 3, 4)], None)
    assert not module.is_end([joint("x_end", -1, [0, 0, 0], axis=up)], 0)


def rigs_without_axes_go_by_names():
    chest = [joint("chest", -1, [0, 0, 1]), joint("arm.L", 0, [1, 0, 1]),
             joint("arm_1.L", 1, [2, 0, 1]), joint("arm_end.L", 2, [3, 0, 1]),
             joint("head", 0, [0, 0, 2])]
    assert tail_of(chest, 0) == ([0, 0, 2], 4)
    assert tail_of(chest, 1) == ([2, 0, 1], 2)
    assert [module.is_end(chest, n) for n in range(5)] == [False, False, False, True, False]


def names_change_no_bone():
    places = {}
    for names in ("auto", "mixamo", "neutral"):
        body = figure()
        bones = rig(body, names=names).data.bones
        places[names] = [place for bone in bones for place in (bone.head_local, bone.tail_local)]
        assert not any("_end" in bone.name for bone in bones)
        if names == "mixamo":
            bone = next(bone for bone in bones if len(bone.children) == 3
                        and "Spine" in bone.name)
            assert [child.name for child in bone.children if child.use_connect] in (
                [], ["mixamorig:Neck"]), bone.name
            assert abs(bone.vector.normalized().x) < 0.05, bone.vector
    assert len(places["auto"]) == len(places["neutral"]) == len(places["mixamo"])
    assert far(places["auto"], places["mixamo"]) < 1e-5
    assert far(places["auto"], places["neutral"]) < 1e-5


run_laws(bones_lie_on_their_axes, rigs_without_axes_go_by_names, names_change_no_bone)
