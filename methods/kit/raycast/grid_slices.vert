// One rectangle for each plane perpendicular to the view, far to near.
layout(std430, binding = 0) readonly buffer Slices {
    vec4 slices[];  // left bottom right top, each −1..1
};
uniform int last;  // number of the farthest plane
uniform float stepLength;

flat out float distance;

void main() {
    vec4 rectangle = slices[gl_InstanceID];
    distance = (float(last - gl_InstanceID) + 0.5) * stepLength;
    gl_Position = vec4((gl_VertexID & 1) == 0 ? rectangle.x : rectangle.z, gl_VertexID < 2 ? rectangle.y : rectangle.w,
                       0, 1);
}
