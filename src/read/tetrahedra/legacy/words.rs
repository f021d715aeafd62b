//! Lines, words and numbers of legacy files.

use super::Reader;
use crate::error::{Error, Result};
use crate::read::values::{Encoding, Fault, NumberType};

impl Reader<'_> {
    /// The words of the next line that has any.
    pub(super) fn keywords(&mut self) -> Option<Vec<String>> {
        loop {
            let line = self.values.line()?;
            if !line.is_empty() {
                return Some(line.split_ascii_whitespace().map(str::to_owned).collect());
            }
        }
    }

    /// An error about the file, with what is wrong.
    pub(super) fn bad<T>(&self, problem: impl ToString) -> Result<T> {
        Err(Error::input(self.path.display(), problem, "correct the file, or write it anew with VTK"))
    }

    /// So many numbers, times so many, after a look at what is left of the file.
    pub(super) fn numbers(&mut self, what: &str, count: usize, each: usize, number: NumberType) -> Result<Vec<f64>> {
        let all = count as u128 * each as u128;
        let left = self.values.left() as u128;
        let least = match self.values.encoding {
            // A digit and a space, but for the last.
            Encoding::Ascii => all.saturating_mul(2).saturating_sub(1),
            _ => all.saturating_mul(number.bytes() as u128),
        };
        if least > left {
            let problem =
                format!("promises {all} numbers under {what}, of at least {least} bytes, where {left} are left");
            return self.bad(problem);
        }
        let mut numbers = Vec::new();
        if numbers.try_reserve_exact(all as usize).is_err() {
            return self.bad(format!("has {all} numbers under {what}, for which there is not enough memory"));
        }
        for _ in 0..all {
            match self.values.next(number) {
                Ok(value) => numbers.push(value),
                Err(Fault::End) => return self.bad(format!("ends under {what}, of {all} numbers")),
                Err(Fault::Word { line, word }) => {
                    return self.bad(format!("has `{}` in line {line}, under {what}", word.escape_debug()));
                }
            }
        }
        if self.values.encoding == Encoding::Ascii {
            // To the begin of the next line.
            self.values.left();
        }
        Ok(numbers)
    }

    /// The word of that place as a number of things.
    pub(super) fn count(&self, words: &[String], at: usize) -> Result<usize> {
        match words.get(at).and_then(|word| word.parse().ok()) {
            Some(count) => Ok(count),
            None => {
                let word = words.get(at).map_or("nothing", String::as_str).escape_debug();
                self.bad(format!("has {word} behind {}, where a number of things stands", words[0].escape_debug()))
            }
        }
    }

    /// The type of numbers that the word of that place names.
    pub(super) fn number_type(&self, words: &[String], at: usize) -> Result<NumberType> {
        let word = words.get(at).map(|word| word.to_ascii_lowercase()).unwrap_or_default();
        Ok(match word.as_str() {
            "char" | "vtktypeint8" => NumberType::I8,
            "unsigned_char" | "vtktypeuint8" => NumberType::U8,
            "short" | "vtktypeint16" => NumberType::I16,
            "unsigned_short" | "vtktypeuint16" => NumberType::U16,
            // Point numbers are written as whole numbers of 32 bits by this name.
            "int" | "vtkidtype" | "vtktypeint32" => NumberType::I32,
            "unsigned_int" | "vtktypeuint32" => NumberType::U32,
            "long" | "vtktypeint64" => NumberType::I64,
            "unsigned_long" | "vtktypeuint64" => NumberType::U64,
            "float" => NumberType::F32,
            "double" => NumberType::F64,
            _ => {
                return self.bad(format!(
                    "has numbers of the type `{}` behind {}",
                    word.escape_debug(),
                    words[0].escape_debug()
                ));
            }
        })
    }

    /// The name that a word is, with its signs for spaces and others.
    pub(super) fn named(&self, words: &[String], at: usize) -> Result<String> {
        let Some(word) = words.get(at) else {
            return self.bad(format!("has {} without a name", words[0].escape_debug()));
        };
        let bytes = word.as_bytes();
        let (mut name, mut i) = (Vec::new(), 0);
        while i < bytes.len() {
            let code = word.get(i + 1..i + 3).and_then(|code| u8::from_str_radix(code, 16).ok());
            match (bytes[i], code) {
                (b'%', Some(code)) => {
                    name.push(code);
                    i += 3;
                }
                (byte, _) => {
                    name.push(byte);
                    i += 1;
                }
            }
        }
        Ok(String::from_utf8_lossy(&name).into_owned())
    }

    /// The number of a point, or of points.
    pub(super) fn whole(&self, number: f64) -> Result<u32> {
        let whole = number as u32;
        if f64::from(whole) == number {
            return Ok(whole);
        }
        self.bad(format!("has {number} where a point or a number of points stands"))
    }
}
