uniform bool orthographic;
uniform bool flat_colour;  // the casing's
uniform vec4 casing;
in vec3 seen;
in vec3 normal_seen;
in vec4 tint;
out vec4 result;
void main() {
  vec3 to_viewer = orthographic ? vec3(0.0, 0.0, 1.0) : normalize(-seen);
  vec3 colour = flat_colour ? casing.rgb : lit(tint.rgb, normalize(normal_seen), to_viewer);
  result = vec4(colour * tint.a, tint.a);
}
