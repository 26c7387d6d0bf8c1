"""networkx reads .graphml and, through json, .json; and writes both for the program to read."""
import json
import math
import pathlib
import sys

from truth import Graph, expect, expect_same, module, samples

networkx = module("networkx", "python3-networkx")


def graph_of(graph):
    names = list(graph.nodes)
    number = {name: k for k, name in enumerate(names)}
    nodes = [graph.nodes[name] for name in names]
    radii = [node["radius"] for node in nodes] if nodes and "radius" in nodes[0] else None
    return Graph([(node["x"], node["y"], node["z"]) for node in nodes],
                 [(number[a], number[b]) for a, b in graph.edges], radii)


folder = pathlib.Path(sys.argv[1])
for name, truth in samples(folder):
    graph = networkx.read_graphml(folder / f"{name}.graphml")
    found = graph_of(graph)
    expect_same(f"{name}.graphml", found, truth)
    for a, b, data in graph.edges(data=True):
        ends = [[graph.nodes[n][c] for c in "xyz"] for n in (a, b)]
        expect(math.isclose(data["length"], math.dist(*ends), rel_tol=1e-14),
               f"{name}.graphml: length of {a}-{b}")

    document = json.loads((folder / f"{name}.json").read_text())
    found = Graph(document["nodes"], document["edges"], document["radii"] or None)
    expect_same(f"{name}.json", found, truth)
    expect(document["parameters"] == {"detail": 0.5}, f"{name}.json: parameters")
    expect(document["certificate"] == {"genus": 0}, f"{name}.json: certificate")
    expect(document["provenance"] == "a <test> & more -- here", f"{name}.json: provenance")
    expect(len(document["node_of_vertex"]) == 3 * len(truth.points), f"{name}.json: vertex map")
    cycles = networkx.Graph(document["edges"])
    expect(len(networkx.cycle_basis(cycles)) == len(networkx.cycle_basis(graph)),
           f"{name}: cycles differ between .json and .graphml")

    networkx.write_graphml(graph, folder / f"foreign-{name}-networkx.graphml")
    (folder / f"foreign-{name}-networkx.json").write_text(
        json.dumps(networkx.node_link_data(graph)))
