#version 450
layout(location = 0) flat in uint flat_payload;
layout(location = 0) out uint colour;
void main() { colour = flat_payload; }
