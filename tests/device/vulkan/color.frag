// One colour for every fragment.
#version 460

layout(early_fragment_tests) in;

layout(push_constant) uniform Draw {
    vec4 color;
} this_draw;

layout(location = 0) out vec4 color;

void main() {
    color = this_draw.color;
}
