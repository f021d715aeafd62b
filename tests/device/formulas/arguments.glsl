// Arguments and results of the functions under test; each invocation knows how many of the vec4 are its own.

layout(local_size_x = 64) in;

layout(set = 0, binding = 20, std430) readonly buffer Arguments {
    vec4 values[];
} arguments;

layout(set = 0, binding = 21, std430) writeonly buffer Results {
    vec4 values[];
} results;
