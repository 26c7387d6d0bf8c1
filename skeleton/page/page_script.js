"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);

// ---- Numbers ----
function rowsOf(csv) {
  const [head, ...lines] = csv.trim().replace(/\binf\b/g, "Infinity").split("\n").map((line) => line.split(","));
  return { head, rows: lines.map((line) => Object.fromEntries(head.map((name, k) => [name, line[k]]))) };
}
const branches = rowsOf(data.branches);
const profiles = rowsOf(data.profiles);
const junctions = rowsOf(data.junctions);
const isNumber = (text) => text !== "" && !Number.isNaN(Number(text));
const shown = (text) => text === "Infinity" ? "\u221e" : shownNumber(text);
const shownNumber = (text) => (isNumber(text) && !Number.isInteger(Number(text)) ? Number(Number(text).toPrecision(4)).toString() : text);
const colourOf = (branch) => data.colours[branch] || [0.63, 0.63, 0.63];
const css = (branch) => `rgb(${colourOf(branch).map((part) => Math.round(255 * part)).join(",")})`;
let chosen = -1;

function fillTable(table, { head, rows }, columns, chooses) {
  const kept = columns.filter((name) => head.includes(name));
  const body = document.createElement("tbody");
  const lines = rows.map((row) => {
    const line = document.createElement("tr");
    kept.forEach((name, k) => {
      const cell = line.insertCell();
      if (k === 0 && chooses) {
        const swatch = document.createElement("i");
        swatch.className = "swatch";
        swatch.style.background = css(Number(row.branch));
        cell.append(swatch);
      }
      cell.append(row[name].split(" ").map(shown).join(" "));
    });
    if (chooses) {
      line.dataset.branch = row.branch;
      line.addEventListener("click", () => choose(Number(row.branch) === chosen ? -1 : Number(row.branch)));
    }
    return { line, row };
  });
  const top = document.createElement("tr");
  kept.forEach((name) => {
    const cell = document.createElement("th");
    cell.textContent = name.replaceAll("_", " ");
    cell.tabIndex = 0;
    const sort = () => {
      const up = cell.getAttribute("aria-sort") !== "ascending";
      top.querySelectorAll("th").forEach((other) => other.removeAttribute("aria-sort"));
      cell.setAttribute("aria-sort", up ? "ascending" : "descending");
      lines.sort((a, b) => {
        const [x, y] = [a.row[name], b.row[name]];
        if (x === "" || y === "") return (x === "") - (y === "");
        const order = isNumber(x) && isNumber(y) ? Number(x) - Number(y) : x.localeCompare(y);
        return up ? order : -order;
      });
      body.append(...lines.map(({ line }) => line));
    };
    cell.addEventListener("click", sort);
    cell.addEventListener("keydown", (event) => { if (event.key === "Enter") sort(); });
    top.append(cell);
  });
  const header = document.createElement("thead");
  header.append(top);
  body.append(...lines.map(({ line }) => line));
  table.append(header, body);
}

function element(name, attributes, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
  if (text !== undefined) made.textContent = text;
  return made;
}

function drawProfile(branch) {
  const place = byId("profile");
  place.replaceChildren();
  const rows = profiles.rows.filter((row) => Number(row.branch) === branch);
  byId("profile-title").textContent = branch < 0 ? "Profile: choose a branch" : `Profile of branch ${branch}`;
  if (rows.length < 2) return;
  const [width, height, left, low] = [520, 240, 46, 210];
  const s = rows.map((row) => Number(row.s));
  const length = s[s.length - 1] || 1;
  const curves = [["equivalent_diameter", "equivalent diameter", css(branch)], ["inscribed_radius", "inscribed radius", "var(--soft)"]];
  const top = Math.max(...rows.flatMap((row) => curves.map(([name]) => Number(row[name]) || 0))) || 1;
  const x = (at) => left + ((width - left - 10) * at) / length;
  const y = (value) => low - ((low - 12) * value) / top;
  const svg = element("svg", { viewBox: `0 0 ${width} ${height}`, role: "img" });
  rows.forEach((row, k) => {
    if (row.near_junction !== "1") return;
    const from = k === 0 ? s[0] : (s[k - 1] + s[k]) / 2;
    const to = k === rows.length - 1 ? s[k] : (s[k] + s[k + 1]) / 2;
    svg.append(element("rect", { x: x(from), y: 12, width: Math.max(0, x(to) - x(from)), height: low - 12, fill: "var(--line)", opacity: 0.6 }));
  });
  svg.append(element("path", { d: `M${left} 12V${low}H${width - 10}`, stroke: "var(--soft)", fill: "none" }));
  [0, 0.5, 1].forEach((share) => {
    svg.append(element("text", { x: left - 6, y: y(share * top) + 4, "text-anchor": "end" }, (share * top).toPrecision(3)));
    svg.append(element("text", { x: x(share * length), y: low + 16, "text-anchor": "middle" }, (share * length).toPrecision(3)));
  });
  curves.forEach(([name, , colour]) => {
    let path = "";
    rows.forEach((row, k) => {
      if (row[name] === "") { path += " "; return; }
      path += `${k > 0 && rows[k - 1][name] !== "" ? "L" : "M"}${x(s[k]).toFixed(1)} ${y(Number(row[name])).toFixed(1)}`;
    });
    svg.append(element("path", { d: path, stroke: colour, "stroke-width": 2, fill: "none" }));
  });
  svg.append(element("text", { x: width - 10, y: height - 2, "text-anchor": "end" }, "length along the branch"));
  const legend = document.createElement("div");
  legend.className = "legend";
  curves.forEach(([, words, colour]) => {
    const swatch = document.createElement("i");
    swatch.className = "swatch";
    swatch.style.background = colour;
    const entry = document.createElement("span");
    entry.append(swatch, words);
    legend.append(entry);
  });
  legend.append("shaded: near a junction");
  place.append(svg, legend);
}

function choose(branch) {
  chosen = branch;
  document.querySelectorAll("#branches tbody tr").forEach((line) => {
    line.classList.toggle("chosen", Number(line.dataset.branch) === branch);
    if (branch < 0 || Number(line.dataset.branch) !== branch) return;
    const scroll = line.closest(".scroll");  // the page itself stays
    if (line.offsetTop < scroll.scrollTop + 40 || line.offsetTop > scroll.scrollTop + scroll.clientHeight - 30) {
      scroll.scrollTop = line.offsetTop - scroll.clientHeight / 2;
    }
  });
  const row = branches.rows[branch];
  byId("named").textContent = row ? `branch ${branch}: ${row.kind}, length ${shown(row.length)}` : "";
  drawProfile(branch);
  draw();
  history.replaceState(null, "", branch < 0 ? "#" : `#branch=${branch}`);
}

// ---- Shapes ----
function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) bytes[k] = text.charCodeAt(k);
  return bytes.buffer;
}

function normalsOf(places, triangles) {
  const normals = new Float32Array(places.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const [ux, uy, uz] = [places[b] - places[a], places[b + 1] - places[a + 1], places[b + 2] - places[a + 2]];
    const [vx, vy, vz] = [places[c] - places[a], places[c + 1] - places[a + 1], places[c + 2] - places[a + 2]];
    const normal = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const corner of [a, b, c]) for (let axis = 0; axis < 3; ++axis) normals[corner + axis] += normal[axis];
  }
  return normals;
}

/** Tubes along the edges and balls at the nodes, each vertex with the number of its branch. */
function tubesOf(nodes, lines, radius) {
  const places = [], normals = [], branch = [], triangles = [];
  const sides = 10;
  const ring = (centre, u, v, number) => {
    const first = places.length / 3;
    for (let k = 0; k < sides; ++k) {
      const [c, s] = [Math.cos((2 * Math.PI * k) / sides), Math.sin((2 * Math.PI * k) / sides)];
      for (let axis = 0; axis < 3; ++axis) {
        normals.push(c * u[axis] + s * v[axis]);
        places.push(centre[axis] + radius * (c * u[axis] + s * v[axis]));
      }
      branch.push(number);
    }
    return first;
  };
  const ball = (centre, size, number) => {
    const first = places.length / 3;
    const rows = 7;
    for (let i = 0; i <= rows; ++i) {
      for (let k = 0; k <= sides; ++k) {
        const [p, q] = [(Math.PI * i) / rows, (2 * Math.PI * k) / sides];
        const n = [Math.sin(p) * Math.cos(q), Math.sin(p) * Math.sin(q), Math.cos(p)];
        for (let axis = 0; axis < 3; ++axis) { normals.push(n[axis]); places.push(centre[axis] + size * n[axis]); }
        branch.push(number);
        if (i < rows && k < sides) {
          const at = first + i * (sides + 1) + k;
          triangles.push(at, at + sides + 1, at + 1, at + 1, at + sides + 1, at + sides + 2);
        }
      }
    }
  };
  lines.forEach((line, number) => {
    for (let k = 1; k < line.length; ++k) {
      const [a, b] = [nodes[line[k - 1]], nodes[line[k]]];
      const way = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
      const size = Math.hypot(...way);
      if (!(size > 0)) continue;
      const t = way.map((part) => part / size);
      const other = Math.abs(t[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0];
      const u = normalised(cross(t, other));
      const v = cross(t, u);
      const [first, second] = [ring(a, u, v, number), ring(b, u, v, number)];
      for (let side = 0; side < sides; ++side) {
        const next = (side + 1) % sides;
        triangles.push(first + side, first + next, second + side, second + side, first + next, second + next);
      }
      if (k + 1 < line.length) ball(b, radius, number);
    }
    ball(nodes[line[0]], 1.7 * radius, -1);
    ball(nodes[line[line.length - 1]], 1.7 * radius, -1);
  });
  return { places: new Float32Array(places), normals: new Float32Array(normals), branch: new Float32Array(branch), triangles: new Uint32Array(triangles) };
}

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const normalised = (a) => { const size = Math.hypot(...a) || 1; return a.map((part) => part / size); };

// ---- Drawing ----
const canvas = byId("canvas");
const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
const vertexSource = `#version 300 es
in vec3 place; in vec3 normal; in vec3 colour; in float branch;
uniform mat3 turn; uniform vec3 view; uniform vec2 shift; uniform float aspect; uniform float chosen; uniform bool plain;
out vec3 shade; out vec3 across; out float dim;
void main() {
  vec3 at = turn * place * view.x;
  across = turn * normal;
  float depth = at.z - view.y;
  gl_Position = vec4((at.xy + shift) * vec2(1.0 / aspect, 1.0) * 2.4, -depth * 1.02 - 0.4, -depth);
  gl_Position.z = (-depth - 0.5) / 6.0 * gl_Position.w;
  shade = plain ? vec3(0.70, 0.72, 0.75) : colour;
  dim = chosen < -0.5 || abs(branch - chosen) < 0.5 || branch < -0.5 ? 0.0 : 1.0;
}`;
const fragmentSource = `#version 300 es
precision highp float;
in vec3 shade; in vec3 across; in float dim;
uniform float opacity; uniform bool surface;
out vec4 colour;
void main() {
  vec3 n = normalize(across);
  if (!gl_FrontFacing) n = -n;
  float lit = 0.35 + 0.65 * max(0.0, dot(n, normalize(vec3(0.3, 0.5, 0.9))));
  float alpha = surface ? opacity + (1.0 - opacity) * opacity * pow(1.0 - abs(n.z), 3.0) * 1.5 : 1.0;
  vec3 base = mix(shade, vec3(0.62), 0.82 * dim);
  colour = vec4(base * lit * alpha, alpha);
}`;

function programOf(vertex, fragment) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  return program;
}

function meshOf(program, { places, normals, branch, triangles }) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  const colours = new Float32Array(places.length);
  branch.forEach((number, k) => colours.set(number < 0 ? [0.25, 0.27, 0.3] : colourOf(number), 3 * k));
  for (const [name, values, size] of [["place", places, 3], ["normal", normals, 3], ["colour", colours, 3], ["branch", branch, 1]]) {
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    const at = gl.getAttribLocation(program, name);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, size, gl.FLOAT, false, 0, 0);
  }
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
  return { array, count: triangles.length };
}

// Columns of the turn are what the axes become: the rows right, up and out of the page, across.
const home = () => ({ turn: [0, 1, 2].flatMap((column) => [0, 1, 2].map((row) => data.view[3 * row + column])), zoom: 1.15, shift: [0, 0] });
let camera = home();
const distance = 3.2;
let draw = () => {};

if (gl) {
  const program = programOf(vertexSource, fragmentSource);
  const places = new Float32Array(bytesOf(data.surface.places));
  const triangles = new Uint32Array(bytesOf(data.surface.triangles));
  const labels = Float32Array.from(new Int32Array(bytesOf(data.surface.branch)));
  const surface = meshOf(program, { places, normals: normalsOf(places, triangles), branch: labels, triangles });
  const tubes = meshOf(program, tubesOf(data.nodes, data.lines, 0.0055));
  const at = (name) => gl.getUniformLocation(program, name);
  const uniforms = Object.fromEntries(["turn", "view", "shift", "aspect", "chosen", "plain", "opacity", "surface"].map((name) => [name, at(name)]));
  gl.enable(gl.BLEND);
  gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  const paint = (mesh) => { gl.bindVertexArray(mesh.array); gl.drawElements(gl.TRIANGLES, mesh.count, gl.UNSIGNED_INT, 0); };
  draw = () => {
    const scale = window.devicePixelRatio || 1;
    canvas.width = Math.round(canvas.clientWidth * scale);
    canvas.height = Math.round(canvas.clientHeight * scale);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.useProgram(program);
    gl.uniformMatrix3fv(uniforms.turn, false, camera.turn);
    gl.uniform3f(uniforms.view, camera.zoom, distance, 0);
    gl.uniform2f(uniforms.shift, ...camera.shift);
    gl.uniform1f(uniforms.aspect, canvas.width / canvas.height);
    gl.uniform1f(uniforms.chosen, chosen);
    gl.enable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    gl.uniform1i(uniforms.plain, 0);
    gl.uniform1i(uniforms.surface, 0);
    paint(tubes);
    const opacity = Number(byId("opacity").value) / 100;
    if (opacity <= 0) return;
    gl.uniform1i(uniforms.plain, byId("coloured").checked ? 0 : 1);
    gl.uniform1i(uniforms.surface, 1);
    gl.uniform1f(uniforms.opacity, opacity);
    gl.uniform1f(uniforms.chosen, byId("coloured").checked ? chosen : -1);
    gl.enable(gl.CULL_FACE);
    if (opacity < 1) { gl.depthMask(false); gl.cullFace(gl.FRONT); paint(surface); gl.depthMask(true); }
    gl.cullFace(gl.BACK);
    // The nearest front face alone: its depth first, its colour then.
    gl.colorMask(false, false, false, false); paint(surface); gl.colorMask(true, true, true, true);
    gl.depthFunc(gl.LEQUAL); paint(surface); gl.depthFunc(gl.LESS);
  };
} else {
  byId("named").textContent = "This browser has no WebGL 2; the tables below need none.";
}

/** Where a node is on the canvas, in its pixels, and how deep. */
function projected(node) {
  const m = camera.turn;
  const [x, y, z] = [0, 1, 2].map((row) => camera.zoom * (m[row] * node[0] + m[3 + row] * node[1] + m[6 + row] * node[2]));
  const w = distance - z;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  return [((((x + camera.shift[0]) * 2.4 * height) / width / w + 1) * width) / 2, ((1 - ((y + camera.shift[1]) * 2.4) / w) * height) / 2, w];
}

function branchAt(x, y) {
  let [best, least] = [-1, 14];
  data.lines.forEach((line, number) => line.forEach((node) => {
    const [u, v] = projected(data.nodes[node]);
    const off = Math.hypot(u - x, v - y);
    if (off < least) [best, least] = [number, off];
  }));
  return best;
}

function turned(turn, dx, dy) {
  const angle = Math.hypot(dx, dy);
  if (angle === 0) return turn;
  const [ux, uy] = [dy / angle, dx / angle];
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const by = [c + ux * ux * (1 - c), ux * uy * (1 - c), -uy * s, ux * uy * (1 - c), c + uy * uy * (1 - c), ux * s, uy * s, -ux * s, c];
  const result = [];
  for (let column = 0; column < 3; ++column) for (let row = 0; row < 3; ++row) {
    result.push(by[row] * turn[3 * column] + by[3 + row] * turn[3 * column + 1] + by[6 + row] * turn[3 * column + 2]);
  }
  return result;
}

let grip = null;
canvas.addEventListener("pointerdown", (event) => {
  canvas.setPointerCapture(event.pointerId);
  grip = { x: event.clientX, y: event.clientY, moved: 0 };
});
canvas.addEventListener("pointermove", (event) => {
  if (!grip) return;
  const [dx, dy] = [event.clientX - grip.x, event.clientY - grip.y];
  grip = { x: event.clientX, y: event.clientY, moved: grip.moved + Math.abs(dx) + Math.abs(dy) };
  if (event.shiftKey || event.buttons === 4) {
    camera.shift = [camera.shift[0] + (dx * 2.7) / canvas.clientHeight, camera.shift[1] - (dy * 2.7) / canvas.clientHeight];
  } else {
    camera.turn = turned(camera.turn, dx * 0.008, dy * 0.008);
  }
  draw();
});
canvas.addEventListener("pointerup", (event) => {
  const box = canvas.getBoundingClientRect();
  if (grip && grip.moved < 4) choose(branchAt(event.clientX - box.left, event.clientY - box.top));
  grip = null;
});
canvas.addEventListener("wheel", (event) => {
  event.preventDefault();
  camera.zoom = Math.min(2.4, Math.max(0.2, camera.zoom * Math.exp(-event.deltaY * 0.001)));
  draw();
}, { passive: false });
byId("home").addEventListener("click", () => { camera = home(); draw(); });
byId("opacity").addEventListener("input", () => draw());
byId("coloured").addEventListener("change", () => draw());
window.addEventListener("resize", () => draw());

// ---- The page ----
byId("title").textContent = data.title;
byId("counts").textContent = data.counts;
byId("verdict").textContent = data.failures === "" ? "certificate holds" : data.failures;
byId("verdict").className = data.failures === "" ? "holds" : "fails";
byId("certificate").textContent = data.certificate;
byId("provenance").textContent = data.provenance;
fillTable(byId("branches"), branches, ["branch", "kind", "length", "tortuosity", "mean_radius", "radius_min", "radius_max", "life", "parent", "parent_angle", "curvature", "torsion", "centrifugal_order", "strahler_order", "area", "volume", "nodes", "component"], true);
fillTable(byId("junctions"), junctions, ["node", "degree", "branches", "angles", "planarity"], false);
const named = /^#branch=(\d+)$/.exec(location.hash);
choose(named && Number(named[1]) < branches.rows.length ? Number(named[1]) : -1);
