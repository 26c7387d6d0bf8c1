uniform bool orthographic;
uniform bool skin;       // half transparent
uniform float strength;  // of the skin
uniform vec3 inner;      // tint of what is seen from inside
uniform sampler2D picture;
uniform bool has_picture;
uniform bool cut_out;  // not seen where the picture is transparent
in vec2 place;
in vec3 seen;
in vec3 normal_seen;
in vec4 tint;
flat in vec4 tint_of_face;
uniform bool categories;  // no colours between two of them
out vec4 result;
void main() {
  vec3 to_viewer = orthographic ? vec3(0.0, 0.0, 1.0) : normalize(-seen);
  vec3 normal = normal_seen;
  if (dot(normal, normal) < 1e-12) normal = cross(dFdx(seen), dFdy(seen));
  normal = normalize(normal);
  bool front = dot(normal, to_viewer) > 0.0;
  if (!front && !gl_FrontFacing) normal = -normal;
  vec3 own = categories ? tint_of_face.rgb : tint.rgb;
  if (has_picture) {
    vec4 there = texture(picture, place);
    if (cut_out && there.a < 0.5) discard;
    own *= there.rgb;
  }
  if (!gl_FrontFacing) own *= inner;
  vec3 colour = lit(own, normal, to_viewer);
  result = skin ? glass(colour, own, dot(normal, to_viewer), strength) : vec4(colour, 1.0);
}
