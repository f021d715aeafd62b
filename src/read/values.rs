//! The numbers of a file, as text or as bytes, one after the other.

/// How the numbers of a file are written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    Ascii,
    Little,
    Big,
}

impl Encoding {
    pub fn of(name: &str) -> Option<Self> {
        match name {
            "ascii" => Some(Self::Ascii),
            "binary_little_endian" => Some(Self::Little),
            "binary_big_endian" => Some(Self::Big),
            _ => None,
        }
    }
}

/// The type of a number.
#[derive(Clone, Copy)]
pub enum NumberType {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl NumberType {
    /// By either of the names of PLY.
    pub fn of(name: &str) -> Option<Self> {
        match name {
            "char" | "int8" => Some(Self::I8),
            "uchar" | "uint8" => Some(Self::U8),
            "short" | "int16" => Some(Self::I16),
            "ushort" | "uint16" => Some(Self::U16),
            "int" | "int32" => Some(Self::I32),
            "uint" | "uint32" => Some(Self::U32),
            "float" | "float32" => Some(Self::F32),
            "double" | "float64" => Some(Self::F64),
            _ => None,
        }
    }

    pub fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// The number in eight bytes, lowest first, of which it takes the front ones.
    fn value(self, bytes: [u8; 8]) -> f64 {
        let [a, b, c, d, ..] = bytes;
        match self {
            Self::I8 => f64::from(a as i8),
            Self::U8 => f64::from(a),
            Self::I16 => f64::from(i16::from_le_bytes([a, b])),
            Self::U16 => f64::from(u16::from_le_bytes([a, b])),
            Self::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
            Self::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
            Self::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
            // Rounded beyond 2^53.
            Self::I64 => i64::from_le_bytes(bytes) as f64,
            Self::U64 => u64::from_le_bytes(bytes) as f64,
            Self::F64 => f64::from_le_bytes(bytes),
        }
    }
}

/// Why there is no number.
pub enum Fault {
    /// The file is over.
    End,
    /// A line holds a word that is none, or one word too many.
    Word { line: usize, word: String },
}

/// The numbers that are still to be read.
#[derive(Clone)]
pub struct Values<'a> {
    pub encoding: Encoding,
    rest: &'a [u8],
    line: usize,
}

impl<'a> Values<'a> {
    /// The numbers in `rest`, which begins behind so many lines.
    pub fn new(encoding: Encoding, rest: &'a [u8], lines: usize) -> Self {
        Self { encoding, rest, line: lines + 1 }
    }

    /// The bytes that are not read yet; of text those from the next word on.
    pub fn left(&mut self) -> usize {
        if self.encoding == Encoding::Ascii {
            self.skip(u8::is_ascii_whitespace);
        }
        self.rest.len()
    }

    /// # Errors
    /// When none follows.
    pub fn next(&mut self, number: NumberType) -> Result<f64, Fault> {
        if self.encoding == Encoding::Ascii {
            self.skip(u8::is_ascii_whitespace);
            let word = self.word().ok_or(Fault::End)?;
            let value = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
            return value.ok_or_else(|| self.fault(word));
        }
        let (bytes, rest) = self.rest.split_at_checked(number.bytes()).ok_or(Fault::End)?;
        self.rest = rest;
        let mut lowest_first = [0; 8];
        lowest_first[..bytes.len()].copy_from_slice(bytes);
        if self.encoding == Encoding::Big {
            lowest_first[..bytes.len()].reverse();
        }
        Ok(number.value(lowest_first))
    }

    /// The text up to the end of the line, without it; none where nothing follows.
    pub fn line(&mut self) -> Option<String> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|b| *b == b'\n').unwrap_or(self.rest.len());
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest.get(1..).unwrap_or_default();
        self.line += 1;
        Some(String::from_utf8_lossy(line).trim().to_owned())
    }

    /// Lines so far, and the one at hand.
    pub fn line_number(&self) -> usize {
        self.line
    }

    /// Ends a row, which in text is a line.
    ///
    /// # Errors
    /// When the line goes on.
    pub fn end_row(&mut self) -> Result<(), Fault> {
        if self.encoding != Encoding::Ascii {
            return Ok(());
        }
        self.skip(|b| matches!(b, b' ' | b'\t'));
        if self.rest.first().is_some_and(|b| !b.is_ascii_whitespace()) {
            let word = self.word().unwrap_or_default();
            return Err(self.fault(word));
        }
        Ok(())
    }

    fn skip(&mut self, is_skipped: impl Fn(&u8) -> bool) {
        let length = self.rest.iter().position(|b| !is_skipped(b)).unwrap_or(self.rest.len());
        let (skipped, rest) = self.rest.split_at(length);
        self.line += skipped.iter().filter(|b| **b == b'\n').count();
        self.rest = rest;
    }

    /// The word that begins here.
    fn word(&mut self) -> Option<&'a [u8]> {
        let length = self.rest.iter().position(u8::is_ascii_whitespace).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(length);
        self.rest = rest;
        (length > 0).then_some(word)
    }

    fn fault(&self, word: &[u8]) -> Fault {
        Fault::Word { line: self.line, word: String::from_utf8_lossy(word).into_owned() }
    }
}
