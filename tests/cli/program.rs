//! Starts the program as a user does. `DEPTHLEAP_RUNNER`, words with spaces between, is put in front of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

/// A folder of its own, in which the program is started.
pub struct Place {
    folder: TempDir,
    /// No Vulkan driver is to be found from here.
    pub driverless: bool,
}

/// What a run of the program left.
pub struct Ended {
    pub code: Option<i32>,
    pub out: Vec<u8>,
    pub err: String,
}

impl Place {
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap(), driverless: false }
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    pub fn file(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub fn json(&self, name: &str) -> serde_json::Value {
        serde_json::from_slice(&self.read(name)).unwrap()
    }

    /// The program, to be given arguments with spaces between.
    pub fn command(&self, arguments: &str) -> Command {
        self.after(&std::env::var("DEPTHLEAP_RUNNER").unwrap_or_default(), arguments)
    }

    /// The program with other words in front of it.
    pub fn after(&self, runner: &str, arguments: &str) -> Command {
        let words: Vec<&str> = runner.split_whitespace().chain([env!("CARGO_BIN_EXE_depthleap")]).collect();
        let mut command = Command::new(words[0]);
        command.args(&words[1..]).args(arguments.split_whitespace()).current_dir(self.path());
        if self.driverless {
            command.env("VK_DRIVER_FILES", "/nonexistent").env("VK_ICD_FILENAMES", "/nonexistent");
        }
        command
    }

    pub fn run(&self, arguments: &str) -> Ended {
        Ended::of(self.command(arguments).output().unwrap())
    }

    /// Runs what has to go well.
    pub fn done(&self, arguments: &str) -> Ended {
        let ended = self.run(arguments);
        assert_eq!(ended.code, Some(0), "{arguments}: {}", ended.err);
        ended
    }

    /// Runs what has to be refused with this exit code, in one line of standard error with all of `parts`, and leaves
    /// every file and folder as it was.
    pub fn refused(&self, arguments: &str, code: i32, parts: &[&str]) {
        let before = self.content();
        let ended = self.run(arguments);
        let err = &ended.err;
        assert_eq!(ended.code, Some(code), "{arguments}: {err}");
        assert!(err.starts_with("error: ") && !err.contains("panicked"), "{arguments}: {err}");
        for part in parts {
            assert!(err.contains(part), "{arguments}: no `{part}` in: {err}");
        }
        // The messages of the option parser have their usage and their tip on lines of their own.
        let of_the_parser = code == 2 && err.ends_with("For more information, try '--help'.\n");
        assert!(of_the_parser || (err.lines().count() == 1 && err.contains("; ")), "{arguments}: {err}");
        assert!(ended.out.is_empty(), "{arguments} wrote to standard output");
        assert_eq!(self.content(), before, "{arguments} changed a file");
    }

    /// Every file with its bytes, every folder.
    fn content(&self) -> BTreeMap<PathBuf, Option<Vec<u8>>> {
        let mut content = BTreeMap::new();
        let mut folders = vec![self.path().to_path_buf()];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    folders.push(path.clone());
                }
                content.insert(path.clone(), std::fs::read(&path).ok());
            }
        }
        content
    }
}

impl Ended {
    pub fn of(output: Output) -> Self {
        let err = String::from_utf8_lossy(&output.stderr).into_owned();
        Self { code: output.status.code(), out: output.stdout, err }
    }

    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.out).into_owned()
    }
}

/// Width, height and premultiplied RGBA of an NPY picture.
pub fn npy(bytes: &[u8]) -> ([u64; 2], Vec<f32>) {
    let file = npyz::NpyFile::new(bytes).unwrap();
    let &[height, width, 4] = file.shape() else { panic!("shape {:?}", file.shape()) };
    ([width, height], file.into_vec::<f32>().unwrap())
}
