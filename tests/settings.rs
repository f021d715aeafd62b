//! All settings: each key has its option, each number its range, and each option changes its key.

use clap::{Arg, Args, Command, FromArgMatches};
use depthleap::projection::PROJECTIONS;
use depthleap::scene::limits::Allowed;
use depthleap::scene::settings::{Key, Settings, SettingsOptions};
use toml::{Table, Value};

/// Keys that no option of theirs sets, and why.
const WITHOUT_OPTION: [(&str, &str); 13] = [
    ("volume.path", "the argument SCENE|VOLUME names it"),
    ("volume.builtin", "the argument SCENE|VOLUME names it"),
    ("volume.mesh", "the argument SCENE|VOLUME names it"),
    ("transfer.preset", "--tf names it"),
    ("transfer.file", "--tf names it"),
    ("transfer.points", "they are too many for a command line"),
    ("surface.levels", "they are too many for a command line"),
    ("environment.image", "--environment names it"),
    ("environment.builtin", "--environment names it"),
    ("effects.translucency", "--translucency gives its absorption"),
    ("effects.file", "--effect names it"),
    ("effects.hash", "runs note it"),
    ("method.name", "--method is a list in some commands, and so stands in each of them"),
];

/// Options that are no keys, and the key that each of them changes.
const WITHOUT_KEY: [(&str, &str); 7] = [
    ("tf", "transfer.preset"),
    ("azimuth", "camera.eye"),
    ("elevation", "camera.eye"),
    ("distance", "camera.eye"),
    ("environment", "environment.builtin"),
    ("effect", "effects.file"),
    ("translucency", "effects.translucency"),
];

/// Keys that may be absent and have no range of their own, and why.
const WITHOUT_RANGE: [(&str, &str); 22] = [
    ("volume.array", "a name"),
    ("volume.path", "a name"),
    ("volume.builtin", "a name"),
    ("volume.mesh", "a name"),
    ("volume.range", "its two ends are held against one another"),
    ("volume.dims", "held against the file, or against what memory may hold"),
    ("volume.type", "a word"),
    ("volume.spacing", "held against the file"),
    ("volume.endian", "a word"),
    ("volume.component", "held against the file"),
    ("volume.frame", "held against the file"),
    ("surface.levels", "tables, each with its checks"),
    ("environment.image", "a name"),
    ("environment.builtin", "a name"),
    ("effects.background", "a name"),
    ("effects.file", "a name"),
    ("effects.hash", "held against the file"),
    ("effects.refraction", "a table, whose numbers are held against theirs"),
    ("shells.mode", "a word"),
    ("shells.disabled", "held against the number of shells"),
    ("shells.levels", "held against one another, and their emissions against 0"),
    ("effects.translucency", "a table, whose numbers are held against theirs"),
];

/// What else may be absent: sources of a transfer function, which has checks of its own.
const TRANSFER: [&str; 3] = ["transfer.preset", "transfer.file", "transfer.points"];

/// Values of options that neither their words nor their limits tell.
const VALUES: [(&str, &str); 11] = [
    ("range", "1%,99%"),
    ("no-data", "-9999,-1"),
    ("dims", "3,2,1"),
    ("spacing", "1,2,3"),
    ("component", "luminance"),
    ("frame", "2"),
    ("ortho-height", "1.5"),
    ("iso", "120.5"),
    ("iso-width", "8"),
    ("environment", "sky"),
    ("refraction", "0.2:1,0.4:1.5"),
];

fn path(key: &Key) -> String {
    format!("{}.{}", key.section, key.name)
}

fn table(settings: &Settings) -> Table {
    Table::try_from(settings).unwrap()
}

/// The value of a key, where it is there.
fn value(settings: &Settings, key: &str) -> Option<Value> {
    let (section, name) = key.split_once('.').unwrap();
    table(settings)[section].get(name).cloned()
}

/// Options of sections. `--clip-plane` adds a table `[[clip]]`, of which there may be any number.
fn options() -> Vec<Arg> {
    let command = SettingsOptions::augment_args(Command::new("test"));
    command.get_arguments().filter(|option| option.get_long() != Some("clip-plane")).cloned().collect()
}

#[test]
fn clip_planes_are_added_to_those_of_the_scene_file() {
    let planes = |arguments: &[&str]| -> Vec<Option<[f64; 4]>> {
        let arguments: Vec<String> = arguments.iter().map(|argument| (*argument).to_owned()).collect();
        under(&arguments).clips.iter().map(|clip| clip.plane).collect()
    };
    assert_eq!(planes(&[]), []);
    let (first, second) = ([0.0, -1.0, 0.5, -0.25], [1.0, 0.0, 0.0, 0.0]);
    assert_eq!(planes(&["--clip-plane", "0,-1,0.5,-0.25", "--clip-plane=1,0,0,0"]), [Some(first), Some(second)]);
}

/// The default settings under these arguments.
fn under(arguments: &[String]) -> Settings {
    let command = SettingsOptions::augment_args(Command::new("test").no_binary_name(true));
    let matches = command.try_get_matches_from(arguments).unwrap_or_else(|e| panic!("{arguments:?}: {e}"));
    let mut settings = Settings::default();
    SettingsOptions::from_arg_matches(&matches).unwrap().apply(&mut settings);
    settings
}

#[test]
fn every_key_of_a_scene_file_is_listed() {
    let keys: Vec<String> = Settings::keys().iter().map(path).collect();
    for (section, of_section) in table(&Settings::default()) {
        for name in of_section.as_table().unwrap().keys() {
            assert!(keys.contains(&format!("{section}.{name}")), "{section}.{name}");
        }
    }
    // What is listed is a key: the message about one that is unknown names all that are.
    for key in Settings::keys() {
        let message = toml::from_str::<Settings>(&format!("[{}]\nzzz = 1", key.section)).unwrap_err().to_string();
        assert!(message.contains(&format!("`{}`", key.name)), "{}: {message}", path(&key));
    }
}

#[test]
fn every_key_has_an_option_or_a_reason_for_none() {
    let without: Vec<String> = Settings::keys().iter().filter(|key| key.option.is_none()).map(path).collect();
    assert_eq!(without, WITHOUT_OPTION.map(|(key, _)| key));
}

#[test]
fn every_option_has_a_key_and_changes_it_alone() {
    let keys = Settings::keys();
    for option in options() {
        let long = option.get_long().unwrap();
        let key = match keys.iter().find(|key| option.get_id() == key.id) {
            Some(key) => path(key),
            None => WITHOUT_KEY.iter().find(|(name, _)| *name == long).expect(long).1.to_owned(),
        };
        let mut arguments = vec![format!("--{long}")];
        if option.get_num_args().is_none_or(|count| count.takes_values()) {
            let key = keys.iter().find(|key| option.get_id() == key.id);
            // What has one word only cannot be changed.
            let Some(value) = some_value(&option, key) else { continue };
            arguments.push(value);
        }
        let (before, after) = (Settings::default(), under(&arguments));
        assert_ne!(value(&before, &key), value(&after, &key), "{arguments:?} changes {key}");
        let (section, name) = key.split_once('.').unwrap();
        let others = |settings: &Settings| {
            let mut table = table(settings);
            table[section].as_table_mut().unwrap().remove(name);
            table
        };
        assert_eq!(others(&before), others(&after), "{arguments:?} changes {key} alone");
    }
}

/// A value of an option that is not the default; none where there is no other.
fn some_value(option: &Arg, key: Option<&Key>) -> Option<String> {
    let long = option.get_long().unwrap();
    let words: Vec<String> = match long {
        "projection" => PROJECTIONS.map(|row| row.name.to_owned()).into(),
        _ => option.get_possible_values().iter().map(|word| word.get_name().to_owned()).collect(),
    };
    let default = key.and_then(|key| key.default.clone());
    if let Some((_, value)) = VALUES.iter().find(|(name, _)| *name == long) {
        return Some((*value).to_owned());
    }
    if let Some(word) = words.iter().rfind(|word| default.as_ref() != Some(word)) {
        return Some(word.clone());
    }
    if !words.is_empty() {
        return None;
    }
    Some(match key.and_then(|key| key.limits) {
        None if long == "tf" => "haze".to_owned(),
        None => "3".to_owned(),
        Some(limits) => {
            let default = default.unwrap();
            let separator = if default.contains('x') { "x" } else { "," };
            let number = inside(limits.allowed).into_iter().map(|number| number.to_string());
            let number = number.into_iter().find(|number| !default.split(separator).all(|part| part == number));
            vec![number.expect(long); default.split(separator).count()].join(separator)
        }
    })
}

/// Numbers at the ends of what is allowed.
fn inside(allowed: Allowed) -> Vec<f64> {
    match allowed {
        Allowed::FromTo(low, high) => vec![low, high],
        Allowed::Between(low, high) => vec![low.next_up(), high.next_down()],
        Allowed::AtLeast(low) => vec![low, low + 1.0],
        Allowed::OneOf(all) => all.iter().copied().map(f64::from).collect(),
        Allowed::Finite => vec![f64::MIN, f64::MAX],
    }
}

/// Numbers just beyond what is allowed; `whole` where the setting takes whole numbers.
fn outside(allowed: Allowed, whole: bool) -> Vec<f64> {
    let below = |n: f64| if whole { n - 1.0 } else { n.next_down() };
    let above = |n: f64| if whole { n + 1.0 } else { n.next_up() };
    let mut numbers = match allowed {
        Allowed::FromTo(low, high) => vec![below(low), above(high)],
        Allowed::Between(low, high) => vec![low, high],
        Allowed::AtLeast(low) => vec![below(low)],
        Allowed::OneOf(all) => {
            all.iter().map(|n| f64::from(*n) + 1.0).filter(|n| all.iter().all(|one| f64::from(*one) != *n)).collect()
        }
        Allowed::Finite => vec![],
    };
    if !whole {
        numbers.extend([f64::NAN, f64::INFINITY, f64::NEG_INFINITY]);
    }
    numbers
}

/// The settings with every number of a key set to this one; none where the key cannot hold it.
fn with(key: &Key, like: &Value, number: f64) -> Option<Settings> {
    let set = |value: &Value| match value {
        Value::Integer(_) => Value::Integer(number as i64),
        _ => Value::Float(number),
    };
    let value = match like {
        Value::Array(entries) if entries.is_empty() => Value::Array(vec![Value::Float(number)]),
        Value::Array(entries) => Value::Array(entries.iter().map(set).collect()),
        value => set(value),
    };
    let mut table = table(&Settings::default());
    table[key.section].as_table_mut().unwrap().insert(key.name.to_owned(), value);
    table.try_into().ok()
}

#[test]
fn every_number_has_a_range_that_is_held() {
    for key in Settings::keys() {
        let name = path(&key);
        let default = value(&Settings::default(), &name);
        let Some(limits) = key.limits else {
            let is_word = matches!(default, Some(Value::String(_) | Value::Boolean(_)));
            let has_reason = TRANSFER.contains(&name.as_str()) || WITHOUT_RANGE.iter().any(|(key, _)| *key == name);
            assert!(is_word || default.is_none() && has_reason, "{name} has no range");
            continue;
        };
        // Absent by default: a list of numbers, a number, or a whole number.
        let like = default.unwrap_or(match name.as_str() {
            "volume.no_data" => Value::Array(vec![]),
            "camera.height" | "sampling.error" | "volume.band" | "surface.iso" | "surface.iso_width" => {
                Value::Float(0.0)
            }
            _ => Value::Integer(0),
        });
        let whole = matches!(&like, Value::Integer(_))
            || like.as_array().and_then(|all| all.first()).is_some_and(Value::is_integer);
        for number in inside(limits.allowed) {
            let settings = with(&key, &like, number).unwrap_or_else(|| panic!("{name} cannot hold {number}"));
            assert_eq!(settings.check(), Ok(()), "{name} = {number}");
        }
        let refused: Vec<Settings> =
            outside(limits.allowed, whole).into_iter().filter_map(|number| with(&key, &like, number)).collect();
        assert!(!refused.is_empty(), "{name} can hold nothing outside its range");
        for settings in refused {
            let error = settings.check().expect_err(&name);
            assert_eq!(error.input, format!("{name} (--{})", key.option.as_ref().unwrap()));
            assert_eq!(error.remedy, limits.remedy());
        }
    }
}

#[test]
fn help_tells_defaults_and_ranges() {
    let help = |long: &str| {
        let option = options().into_iter().find(|option| option.get_long() == Some(long)).expect(long);
        option.get_help().unwrap().to_string()
    };
    assert!(help("step").ends_with("spacing [default: 1] [range: 0.0001 to 1000000]"), "{}", help("step"));
    assert!(help("fov").ends_with("degrees [default: 45] [range: above 0 and below 180]"), "{}", help("fov"));
    assert!(help("cell").ends_with("voxels [default: 1] [possible values: 1, 2, 4, 8]"), "{}", help("cell"));
    assert!(help("precision").ends_with("[default: 0.001953125] [range: 1e-9 to 1]"), "{}", help("precision"));
    assert!(help("offset").ends_with("[default: left]"), "{}", help("offset"));
    assert!(help("eye").ends_with("[default: 0,0,1.91]"), "{}", help("eye"));
    assert!(help("viewport").contains("[default: 500x500]"), "{}", help("viewport"));
    assert!(!help("no-planner").contains("[default"), "{}", help("no-planner"));
}
