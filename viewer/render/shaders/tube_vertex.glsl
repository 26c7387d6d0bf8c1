#version 330 core
// A stretched unit cylinder per edge, a unit ball per node (where both ends are one).
layout(location = 0) in vec4 unit;    // x, y on the unit circle or x, y, z on the ball; w: 0..1 along
layout(location = 3) in vec4 from;    // centre and radius in model units
layout(location = 4) in vec4 to;
layout(location = 5) in vec4 from_colour;
layout(location = 6) in vec4 to_colour;
layout(location = 7) in vec3 from_mitre;
layout(location = 8) in vec3 to_mitre;
uniform mat4 view;
uniform mat4 projection;
uniform bool ball;
uniform bool orthographic;
uniform float unit_per_pixel;  // orthographic: model units; else per unit of depth
uniform float least_pixels;    // radius
uniform float more_pixels;     // added to the radius: the casing
out vec3 seen;
out vec3 normal_seen;
out vec4 tint;

float pixel_at(vec3 at) { return unit_per_pixel * (orthographic ? 1.0 : max(-at.z, 0.0)); }

void main() {
  vec3 a = (view * vec4(from.xyz, 1.0)).xyz;
  vec3 b = (view * vec4(to.xyz, 1.0)).xyz;
  float t = ball ? 0.0 : unit.w;
  vec3 centre = mix(a, b, t);
  float pixel = pixel_at(centre);
  float radius = max(mix(from.w, to.w, t), least_pixels * pixel) + more_pixels * pixel;
  vec3 out_of = unit.xyz;
  if (!ball) {
    vec3 along = b - a;
    float length_seen = length(along);
    along = length_seen > 0.0 ? along / length_seen : vec3(0.0, 0.0, 1.0);
    vec3 other = abs(along.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
    vec3 first = normalize(cross(along, other));
    out_of = first * unit.x + cross(along, first) * unit.y;
    normal_seen = out_of;
    vec3 mitre = mat3(view) * (t < 0.5 ? from_mitre : to_mitre);
    float slope = dot(along, mitre);
    if (slope > 0.0) out_of -= along * (dot(out_of, mitre) / slope);
  } else {
    normal_seen = out_of;
  }
  seen = centre + out_of * radius;
  tint = mix(from_colour, to_colour, t);
  gl_Position = projection * vec4(seen, 1.0);
}
