//! A key of a scene file as help, errors and tests know it.

use serde::Serialize;
use serde_json::Value;

use crate::error::Error;
use crate::scene::limits::{Allowed, Limits, WrongValue};

/// A key of a scene file, with what else is said of it in its section.
#[derive(Clone, Debug)]
pub struct Key {
    pub section: &'static str,
    pub name: &'static str,
    /// The option's identifier among the arguments of [`clap`]: the name of the field.
    pub id: &'static str,
    /// The long name of the option that sets it, without the `--`.
    pub option: Option<String>,
    /// The value where nothing is said, as help tells it.
    pub default: Option<String>,
    /// The numbers it may have.
    pub limits: Option<Limits>,
}

impl Key {
    /// The key of a field and the option that clap has for it; `options` holds those of the section.
    pub(super) fn of(options: &clap::Command, section: &'static str, id: &'static str) -> Self {
        let option = options.get_arguments().find(|arg| arg.get_id() == id).and_then(|arg| arg.get_long());
        Self { section, name: id, id, option: option.map(str::to_owned), default: None, limits: None }
    }

    /// How an error names it: `sampling.step (--step)`.
    pub fn named(&self) -> String {
        let key = format!("{}.{}", self.section, self.name);
        self.option.as_ref().map_or(key.clone(), |option| format!("{key} (--{option})"))
    }

    pub(super) fn error(&self, wrong: WrongValue) -> Error {
        Error::usage(self.named(), wrong.problem, wrong.remedy)
    }

    /// What follows its text in the help: ` [default: 1] [range: 0.0001 to 1000000]`.
    pub(super) fn note(&self) -> String {
        let default = self.default.as_ref().map_or(String::new(), |default| format!(" [default: {default}]"));
        let limits = match self.limits.map(|limits| limits.allowed) {
            Some(Allowed::OneOf(all)) => {
                let all: Vec<String> = all.iter().map(u32::to_string).collect();
                format!(" [possible values: {}]", all.join(", "))
            }
            // What a number is anyway needs no words.
            Some(Allowed::Finite) | None => String::new(),
            Some(allowed) => format!(" [range: {}]", allowed.to_string().trim_start_matches("from ")),
        };
        default + &limits
    }
}

/// A value as it is given on the command line: `1`, `left`, `0,1,0`. None for what is absent, empty, or a switch.
pub(super) fn text_of(value: &impl Serialize) -> Option<String> {
    match serde_json::to_value(value).ok()? {
        Value::Null | Value::Bool(_) | Value::Object(_) => None,
        Value::Number(number) => number.as_f64().map(|number| number.to_string()),
        Value::String(word) => Some(word),
        Value::Array(entries) => {
            let entries: Vec<String> = entries.iter().filter_map(text_of).collect();
            (!entries.is_empty()).then(|| entries.join(","))
        }
    }
}
