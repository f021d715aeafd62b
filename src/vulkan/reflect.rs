//! Reads from SPIR-V what a pipeline layout needs to know.

use std::collections::HashMap;

use ash::vk;
use rspirv::dr::{Instruction, Module, Operand, load_words};
use rspirv::spirv::{Decoration, Dim, ExecutionModel, Op, StorageClass};

use crate::error::{Error, Result};

/// A resource a shader declares.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Binding {
    /// The variable's name, or its block's where the block has no instance name.
    pub name: String,
    pub set: u32,
    pub binding: u32,
    pub kind: vk::DescriptorType,
    /// Elements of an array, 1 for anything else.
    pub count: u32,
}

/// Types nest no deeper in any shader a compiler made; a module that refers to itself ends here.
const MAX_DEPTH: u32 = 32;

pub(super) struct Reflection {
    pub stage: vk::ShaderStageFlags,
    pub entry_point: String,
    pub bindings: Vec<Binding>,
    pub push_constants: u32,
    pub execution_modes: Vec<String>,
    pub spec_constants: Vec<(String, u32)>,
}

pub(super) fn reflect(name: &str, words: &[u32]) -> Result<Reflection> {
    let bad = |problem: String| Error::input(format!("shader {name}"), problem, "compile it again from its GLSL");
    let module = load_words(words).map_err(|error| bad(format!("is not valid SPIR-V ({error})")))?;
    let names = ModuleIds::of(&module);
    let [entry] = module.entry_points.as_slice() else {
        return Err(bad(format!("has {} entry points, 1 is needed", module.entry_points.len())));
    };
    let (stage, entry_point) = match entry.operands.as_slice() {
        [Operand::ExecutionModel(model), _, Operand::LiteralString(entry), ..] => {
            let stage = match model {
                ExecutionModel::Vertex => vk::ShaderStageFlags::VERTEX,
                ExecutionModel::Fragment => vk::ShaderStageFlags::FRAGMENT,
                ExecutionModel::GLCompute => vk::ShaderStageFlags::COMPUTE,
                other => return Err(bad(format!("is a {other:?} shader; vertex, fragment and compute are used"))),
            };
            (stage, entry.clone())
        }
        _ => return Err(bad("has a broken entry point".into())),
    };

    let mut bindings = Vec::new();
    let mut push_constants = 0;
    for variable in module.types_global_values.iter().filter(|one| one.class.opcode == Op::Variable) {
        let Some(Operand::StorageClass(class)) = variable.operands.first() else { continue };
        let Some(pointee) = variable.result_type.and_then(|pointer| names.id_operand(pointer, 1)) else { continue };
        match class {
            StorageClass::PushConstant => {
                let bytes = names.bytes(pointee, 0).ok_or_else(|| bad("has push constants of unknown size".into()))?;
                push_constants = u32::try_from(bytes.next_multiple_of(4)).map_err(|_| bad("is too large".into()))?;
            }
            StorageClass::UniformConstant | StorageClass::Uniform | StorageClass::StorageBuffer => {
                let binding = names
                    .binding(variable, *class, pointee)
                    .map_err(|(variable, problem)| bad(format!("{variable}: {problem}")))?;
                bindings.push(binding);
            }
            _ => {}
        }
    }
    bindings.sort_by_key(|one| (one.set, one.binding));
    Ok(Reflection {
        stage,
        entry_point,
        bindings,
        push_constants,
        execution_modes: module.execution_modes.iter().filter_map(execution_mode).collect(),
        spec_constants: names.spec_constants(&module).map_err(|name| bad(format!("{name} is not 32 bits wide")))?,
    })
}

fn execution_mode(instruction: &Instruction) -> Option<String> {
    let [_, Operand::ExecutionMode(mode), rest @ ..] = instruction.operands.as_slice() else { return None };
    let numbers = rest.iter().filter_map(|operand| match operand {
        Operand::LiteralBit32(number) => Some(format!(" {number}")),
        _ => None,
    });
    Some(numbers.fold(format!("{mode:?}"), |mode, number| mode + &number))
}

/// The module's ids by what they define, their names and decorations.
struct ModuleIds<'a> {
    instructions: HashMap<u32, &'a Instruction>,
    names: HashMap<u32, &'a str>,
    decorations: HashMap<(u32, Decoration), u32>,
    members: HashMap<(u32, u32, Decoration), u32>,
}

impl<'a> ModuleIds<'a> {
    fn of(module: &'a Module) -> Self {
        let mut found = Self {
            instructions: HashMap::new(),
            names: HashMap::new(),
            decorations: HashMap::new(),
            members: HashMap::new(),
        };
        for one in &module.types_global_values {
            found.instructions.extend(one.result_id.map(|id| (id, one)));
        }
        for one in &module.debug_names {
            if let (Op::Name, [Operand::IdRef(id), Operand::LiteralString(name)]) = (one.class.opcode, &*one.operands) {
                found.names.insert(*id, name);
            }
        }
        for one in &module.annotations {
            let value = |operands: &[Operand]| match operands {
                [Operand::LiteralBit32(value), ..] => *value,
                _ => 0,
            };
            match (one.class.opcode, &*one.operands) {
                (Op::Decorate, [Operand::IdRef(id), Operand::Decoration(what), rest @ ..]) => {
                    found.decorations.insert((*id, *what), value(rest));
                }
                (
                    Op::MemberDecorate,
                    [Operand::IdRef(id), Operand::LiteralBit32(member), Operand::Decoration(what), rest @ ..],
                ) => {
                    found.members.insert((*id, *member, *what), value(rest));
                }
                _ => {}
            }
        }
        found
    }

    fn id_operand(&self, id: u32, index: usize) -> Option<u32> {
        match self.instructions.get(&id)?.operands.get(index)? {
            Operand::IdRef(id) => Some(*id),
            _ => None,
        }
    }

    fn number(&self, id: u32, index: usize) -> Option<u32> {
        match self.instructions.get(&id)?.operands.get(index)? {
            Operand::LiteralBit32(number) => Some(*number),
            _ => None,
        }
    }

    fn decoration(&self, id: u32, what: Decoration) -> Option<u32> {
        self.decorations.get(&(id, what)).copied()
    }

    fn op(&self, id: u32) -> Op {
        self.instructions.get(&id).map_or(Op::Nop, |one| one.class.opcode)
    }

    /// The binding of a variable; an error is its name and what is wrong.
    fn binding(&self, variable: &Instruction, class: StorageClass, pointee: u32) -> Result<Binding, (String, String)> {
        let id = variable.result_id.unwrap_or_default();
        let (count, kind) = match self.op(pointee) {
            Op::TypeArray => {
                let length = self.id_operand(pointee, 1).and_then(|length| self.number(length, 0));
                (length, self.id_operand(pointee, 0).unwrap_or_default())
            }
            Op::TypeRuntimeArray => (None, pointee),
            _ => (Some(1), pointee),
        };
        let name = [id, kind].iter().filter_map(|id| self.names.get(id)).find(|name| !name.is_empty());
        let name = name.map_or_else(|| format!("variable {id}"), |name| name.to_string());
        let Some(count) = count else { return Err((name, "is an array of unknown length".into())) };
        let descriptor = match (class, self.op(kind)) {
            (StorageClass::UniformConstant, Op::TypeSampledImage) => {
                let image = self.id_operand(kind, 0).and_then(|image| self.dimension(image));
                if image == Some(Dim::DimBuffer) {
                    vk::DescriptorType::UNIFORM_TEXEL_BUFFER
                } else {
                    vk::DescriptorType::COMBINED_IMAGE_SAMPLER
                }
            }
            (StorageClass::UniformConstant, Op::TypeImage) if self.is_storage_image(kind) => {
                vk::DescriptorType::STORAGE_IMAGE
            }
            (StorageClass::UniformConstant, Op::TypeImage) if self.dimension(kind) == Some(Dim::DimSubpassData) => {
                vk::DescriptorType::INPUT_ATTACHMENT
            }
            (StorageClass::StorageBuffer, Op::TypeStruct) => vk::DescriptorType::STORAGE_BUFFER,
            (StorageClass::Uniform, Op::TypeStruct) if self.decoration(kind, Decoration::BufferBlock).is_some() => {
                vk::DescriptorType::STORAGE_BUFFER
            }
            (StorageClass::Uniform, Op::TypeStruct) => vk::DescriptorType::UNIFORM_BUFFER,
            (_, other) => {
                let problem = format!(
                    "{other:?} cannot be bound; use a combined sampler, a texel buffer, a storage image, a subpass input or a buffer block"
                );
                return Err((name, problem));
            }
        };
        let set = self.decoration(id, Decoration::DescriptorSet).unwrap_or(0);
        match self.decoration(id, Decoration::Binding) {
            Some(binding) => Ok(Binding { name, set, binding, kind: descriptor, count }),
            None => Err((name, "has no binding".into())),
        }
    }

    /// Operands of an image type: sampled type, dimension, depth, arrayed, multisampled, sampled (2: storage).
    fn is_storage_image(&self, id: u32) -> bool {
        !matches!(self.dimension(id), Some(Dim::DimBuffer | Dim::DimSubpassData)) && self.number(id, 5) == Some(2)
    }

    fn dimension(&self, id: u32) -> Option<Dim> {
        match self.instructions.get(&id)?.operands.get(1)? {
            Operand::Dim(dimension) => Some(*dimension),
            _ => None,
        }
    }

    /// Bytes of a type with explicit layout, up to the end of its last member.
    fn bytes(&self, id: u32, depth: u32) -> Option<u64> {
        if depth > MAX_DEPTH {
            return None;
        }
        let element = || self.id_operand(id, 0).and_then(|element| self.bytes(element, depth + 1));
        match self.op(id) {
            Op::TypeInt | Op::TypeFloat => Some(u64::from(self.number(id, 0)?) / 8),
            Op::TypeVector => element()?.checked_mul(self.number(id, 1)?.into()),
            // Without a stride of its own (that stands at the member) a matrix takes its columns tightly.
            Op::TypeMatrix => element()?.checked_mul(self.number(id, 1)?.into()),
            Op::TypeArray => {
                let length = self.number(self.id_operand(id, 1)?, 0)?;
                u64::from(self.decoration(id, Decoration::ArrayStride)?).checked_mul(length.into())
            }
            Op::TypeStruct => {
                let mut end = 0;
                for (member, operand) in self.instructions.get(&id)?.operands.iter().enumerate() {
                    let Operand::IdRef(kind) = operand else { return None };
                    let decoration = |what| self.members.get(&(id, member as u32, what)).copied();
                    let bytes = match (self.op(*kind), decoration(Decoration::MatrixStride)) {
                        (Op::TypeMatrix, Some(stride)) => {
                            let columns = self.number(*kind, 1)?;
                            let rows = self.number(self.id_operand(*kind, 0)?, 1)?;
                            let row_major = decoration(Decoration::RowMajor).is_some();
                            u64::from(stride) * u64::from(if row_major { rows } else { columns })
                        }
                        _ => self.bytes(*kind, depth + 1)?,
                    };
                    end = end.max(bytes.checked_add(decoration(Decoration::Offset)?.into())?);
                }
                Some(end)
            }
            _ => None,
        }
    }

    /// ModuleIds and ids; an error is the name of one that is not 32 bits wide.
    fn spec_constants(&self, module: &Module) -> Result<Vec<(String, u32)>, String> {
        let mut found = Vec::new();
        for one in &module.types_global_values {
            let wide = match one.class.opcode {
                Op::SpecConstantTrue | Op::SpecConstantFalse => false,
                Op::SpecConstant => !matches!(one.operands.as_slice(), [Operand::LiteralBit32(_)]),
                _ => continue,
            };
            let Some(id) = one.result_id else { continue };
            let Some(spec) = self.decoration(id, Decoration::SpecId) else { continue };
            let name = self.names.get(&id).map_or_else(|| format!("constant {spec}"), |name| name.to_string());
            if wide {
                return Err(name);
            }
            found.push((name, spec));
        }
        Ok(found)
    }
}
