"""From the program's skeleton to a curve object."""

import bpy

THICKNESS = 0.2  # of the inscribed radius; 1 fills the body


def chains(skeleton):
    """Lists of nodes from junction or tip to junction or tip; closed ones begin anywhere."""
    beside = [[] for _ in skeleton["nodes"]]
    for a, b in skeleton["edges"]:
        beside[a].append(b)
        beside[b].append(a)
    seen = set()

    def follow(node, next_node):
        chain = [node]
        while True:
            seen.add((min(node, next_node), max(node, next_node)))
            chain.append(next_node)
            if len(beside[next_node]) != 2 or next_node == chain[0]:
                return chain
            node, next_node = next_node, [other for other in beside[next_node]
                                          if other != node][0]

    ends_first = sorted(range(len(beside)), key=lambda node: len(beside[node]) == 2)
    found = []
    for node in ends_first:
        for other in beside[node]:
            if (min(node, other), max(node, other)) not in seen:
                found.append(follow(node, other))
    return found


def build_curve(context, skeleton, name):
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions = "3D"
    data.bevel_depth = THICKNESS
    for chain in chains(skeleton):
        spline = data.splines.new("POLY")
        closed = chain[0] == chain[-1]
        nodes = chain[:-1] if closed else chain
        spline.points.add(len(nodes) - 1)
        spline.use_cyclic_u = closed
        for point, node in zip(spline.points, nodes):
            point.co = (*skeleton["nodes"][node], 1)
            point.radius = skeleton["radii"][node]
    thing = bpy.data.objects.new(name, data)
    context.collection.objects.link(thing)
    thing.show_in_front = True
    return thing
