// numbers[i] = FACTOR * numbers[i] + term: whoever ran when, and how often, can be told from the result.
#version 460

layout(local_size_x = 64) in;

layout(constant_id = 3) const uint FACTOR = 1;

layout(push_constant) uniform Step {
    uint term;
} this_step;

layout(set = 0, binding = 0, std430) buffer Numbers {
    uint values[];
} numbers;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < numbers.values.length()) {
        numbers.values[i] = FACTOR * numbers.values[i] + this_step.term;
    }
}
