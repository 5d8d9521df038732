// One triangle that covers the whole image at infinity, the far end of the depth range.
layout(location = 0) out vec3 sight;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    vec4 onNearPlane = clipToEye * vec4(corner, 1.0, 1.0);
    sight = onNearPlane.xyz / onNearPlane.w;
    gl_Position = vec4(corner, 0.0, 1.0);
}
