layout(location = 0) in vec3 position;  // in the object's frame
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 albedo;

uniform mat4 toEye;

layout(location = 0) out vec3 fromEye;
layout(location = 1) out vec3 outwards;
layout(location = 2) out vec3 diffuse;

void main() {
    fromEye = (toEye * vec4(position, 1.0)).xyz;
    outwards = mat3(toEye) * normal;
    diffuse = albedo;
    gl_Position = eyeToClip * vec4(fromEye, 1.0);
}
