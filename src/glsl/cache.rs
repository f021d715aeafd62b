//! Modules on disk, so that a shader is compiled once and not each time the program starts.
//!
//! A module lies in a file named by the key of all it was made from, so that it is never out of date; a file is a magic
//! word, the hash of the key and the module, and the module. Whatever is wrong with the folder or a file in it only
//! means that a shader is compiled again.

use std::io::{self, Read, Write};
use std::path::PathBuf;

use sha2::{Digest, Sha256};

use super::source::Text;
use crate::cache;

/// Begins every file; its last digit changes with what follows.
const MAGIC: [u8; 8] = *b"DLSPIRV1";

/// Bytes of a hash.
const HASH: usize = 32;

/// No module is nearly as large; a file that is larger is not read on.
const LARGEST: u64 = 16 << 20;

/// How the compiler, and the program's own shaders, are told from others: the hash of what it made of every shader when the program was built, and of the
/// text of `compile.rs`.
pub const COMPILER: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/compiler"));

/// Stands for everything a module is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CacheKey([u8; HASH]);

impl CacheKey {
    /// The key of a shader with these defines, in the order they are in.
    pub fn of(text: &Text, defines: &[&str]) -> Self {
        let mut hash = Sha256::new();
        let mut add = |bytes: &[u8]| {
            // With its length, so that no two lists look alike.
            hash.update((bytes.len() as u64).to_le_bytes());
            hash.update(bytes);
        };
        add(COMPILER);
        add(text.file.as_bytes());
        add(&(defines.len() as u64).to_le_bytes());
        defines.iter().for_each(|define| add(define.as_bytes()));
        for (file, text) in &text.parts {
            add(file.as_bytes());
            add(text.as_bytes());
        }
        Self(hash.finalize().into())
    }
}

/// A folder of modules, or none.
#[derive(Clone, Debug)]
pub struct Cache {
    folder: Option<PathBuf>,
}

impl Cache {
    /// `depthleap/shaders` below `$XDG_CACHE_HOME`, else below `~/.cache`; none where there is no home either.
    pub fn of_user() -> Self {
        Self { folder: cache::folder().map(|folder| folder.join("shaders")) }
    }

    pub fn at(folder: PathBuf) -> Self {
        Self { folder: Some(folder) }
    }

    /// Where the module of that key lies, or would lie.
    pub fn path(&self, key: &CacheKey) -> Option<PathBuf> {
        let name: String = key.0.iter().map(|byte| format!("{byte:02x}")).collect();
        self.folder.as_ref().map(|folder| folder.join(format!("{name}.spv")))
    }

    /// The words that were stored with that key; none where they are not there or not as they were written.
    pub fn load(&self, key: &CacheKey) -> Option<Vec<u32>> {
        let file = std::fs::File::open(self.path(key)?).ok()?;
        let mut bytes = Vec::new();
        file.take(LARGEST).read_to_end(&mut bytes).ok()?;
        let (magic, rest) = bytes.split_at_checked(MAGIC.len())?;
        let (hash, module) = rest.split_at_checked(HASH)?;
        let (words, left) = module.as_chunks::<4>();
        let whole = magic == MAGIC && left.is_empty() && hash == sum(key, module);
        whole.then(|| words.iter().map(|word| u32::from_le_bytes(*word)).collect())
    }

    /// Stores words for the next time.
    pub fn store(&self, key: &CacheKey, words: &[u32]) {
        // A cache that cannot be written is slow and nothing else.
        let _ = self.try_store(key, words);
    }

    fn try_store(&self, key: &CacheKey, words: &[u32]) -> io::Result<()> {
        let (Some(folder), Some(path)) = (&self.folder, self.path(key)) else { return Ok(()) };
        std::fs::create_dir_all(folder)?;
        let module: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        // Under a name of its own first: others may read and write here at the same time.
        let mut file = tempfile::NamedTempFile::new_in(folder)?;
        file.write_all(&MAGIC)?;
        file.write_all(&sum(key, &module))?;
        file.write_all(&module)?;
        file.persist(path).map_err(|error| error.error)?;
        Ok(())
    }
}

/// What tells a file that is whole, and under its own name, from any other.
fn sum(key: &CacheKey, module: &[u8]) -> [u8; HASH] {
    Sha256::new().chain_update(key.0).chain_update(module).finalize().into()
}
