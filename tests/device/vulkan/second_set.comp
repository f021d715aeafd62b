// A resource in a descriptor set that this program does not have.
#version 460

layout(local_size_x = 1) in;

layout(set = 1, binding = 0, std430) buffer Numbers {
    uint values[];
} numbers;

void main() {
    numbers.values[0] = 1;
}
