// One colour for every fragment, added to what its pixel held before.
#version 460

layout(early_fragment_tests) in;

layout(push_constant) uniform Draw {
    vec4 color;
} this_draw;

layout(input_attachment_index = 0, set = 0, binding = 3) uniform subpassInput before;

layout(location = 0) out vec4 color;

void main() {
    color = this_draw.color + subpassLoad(before);
}
