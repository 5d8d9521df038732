flat in vec4 colour;
out vec4 result;

void main() {
    result = vec4(chain(colour.r + gl_FragCoord.x));
}
