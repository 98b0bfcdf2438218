#version 450
layout(push_constant) uniform Matrix { mat4 to_clip; };
layout(location = 0) in vec3 position;
layout(location = 1) in uint payload;
layout(location = 0) flat out uint flat_payload;
void main() {
  // Equals transform() in frontend/transform.h: `precise` forbids fused multiply-add.
  precise vec4 p = to_clip[0] * position.x + to_clip[1] * position.y + to_clip[2] * position.z + to_clip[3];
  gl_Position = p;
  flat_payload = payload;
}
