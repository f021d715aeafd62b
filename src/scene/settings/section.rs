//! How a section of the settings is said: [`section!`].

/// Makes a section's settings, its options, what an option changes, and its check, from one entry for each key:
///
/// ```text
/// section! {
///     /// How rays are sampled.
///     #[serde(expecting = "the section [sampling]")]          what errors call it
///     #[command(next_help_heading = "Sampling")]              the options' place in the help
///     SamplingSettings, SamplingOptions, "sampling";          the structs, and the section's name in a scene file
///
///     /// Distance between samples, in voxels                 the field's documentation, and the option's help
///     #[serde(...)]                                           how the key is read and written, where that is special
///     #[arg(long, value_name = "VOXELS")]                     the option, as clap has it; `skip` where there is none
///     step: f64 = 1.0,                                        field, type and default
///         within Limits::from_to(1e-4, 1e6, "voxels {}"),     the numbers allowed: checked, told in help and errors
///         by rule,                                            another check: `fn(&T) -> Option<WrongValue>`
///         default "one";                                      the default in words, where its value is not enough
///
///     #[arg(long)]
///     frame?: usize;                                          a key that may be absent: its type is Option<usize>
///     #[arg(long = "type")]
///     voxel_type as "type"?: VoxelType;                       a key that has another name than its field
///
///     options {                                               options that are no keys, as fields of a clap struct;
///         #[arg(long)]                                        what they change stands in
///         tf: Option<String>,                                 `SamplingOptions::apply_others(&self, &mut Settings)`
///     }
/// }
/// ```
///
/// In the help, default and range are put behind the documentation, which has no full stop at its end.
macro_rules! section {
    (
        $(#[doc = $about:literal])*
        #[serde($($serde_of_all:tt)*)]
        #[command($($command:tt)*)]
        $settings:ident, $options:ident, $section:literal;
        $(
            $(#[doc = $doc:literal])*
            $(#[serde($($serde:tt)*)])?
            #[arg($($arg:tt)*)]
            $name:ident $(as $key:literal)? $(?: $optional:ty)? $(: $type:ty = $default:expr)?
                $(, within $limits:expr)? $(, by $rule:expr)? $(, default $said:expr)?;
        )*
        $(options { $($others:tt)* })?
    ) => {
        $(#[doc = $about])*
        #[derive(Clone, Debug, PartialEq, ::serde::Serialize, ::serde::Deserialize)]
        #[serde(default, deny_unknown_fields, $($serde_of_all)*)]
        pub struct $settings {
            $(
                $(#[doc = $doc])*
                $(#[serde(rename = $key)])?
                $(#[serde($($serde)*)])?
                pub $name: $(Option<$optional>)? $($type)?,
            )*
        }

        impl Default for $settings {
            fn default() -> Self {
                Self { $($name: $(None::<$optional>)? $($default)?,)* }
            }
        }

        #[doc = concat!("The options that set the section `", $section, "`.")]
        #[derive(Clone, Debug, Default, ::clap::Args)]
        #[command($($command)*)]
        pub struct $options {
            $(
                $(#[doc = $doc])*
                #[arg($($arg)*)]
                pub $name: $(Option<$optional>)? $(Option<$type>)?,
            )*
            $($($others)*)?
        }

        impl $options {
            /// Writes the options that were given over `settings`.
            pub fn apply(&self, settings: &mut $settings) {
                $($crate::scene::settings::section::put(&mut settings.$name, self.$name.as_ref());)*
                $crate::scene::settings::section::also!($(self, settings, $($others)*)?);
            }
        }

        impl $settings {
            /// The keys of this section.
            pub(super) fn keys() -> Vec<$crate::scene::settings::Key> {
                let defaults = Self::default();
                let options = <$options as ::clap::Args>::augment_args(::clap::Command::new($section));
                vec![$({
                    #[allow(unused_mut, reason = "not every key says more")]
                    let mut key = $crate::scene::settings::Key {
                        default: $crate::scene::settings::key::text_of(&defaults.$name),
                        ..$crate::scene::settings::Key::of(&options, $section, stringify!($name))
                    };
                    $(key.name = $key;)?
                    $(key.default = Some($said.to_string());)?
                    $(key.limits = Some($limits);)?
                    key
                }),*]
            }

            /// Whether every value is allowed.
            ///
            /// # Errors
            /// When one is not, by its key and its option.
            pub(super) fn check(&self) -> $crate::error::Result<()> {
                #[allow(unused, reason = "not every section has a check")]
                let refuse = |id: &str, wrong: Option<$crate::scene::limits::WrongValue>| match wrong {
                    Some(wrong) => {
                        Self::keys().iter().find(|key| key.id == id).map_or(Ok(()), |key| Err(key.error(wrong)))
                    }
                    None => Ok(()),
                };
                $(
                    $(refuse(stringify!($name), $limits.wrong(&self.$name))?;)?
                    $(refuse(stringify!($name), $rule(&self.$name))?;)?
                )*
                Ok(())
            }
        }
    };
}

/// Applies the options that are no keys, where a section has some.
macro_rules! also {
    () => {};
    ($options:ident, $settings:ident, $($others:tt)*) => {
        $options.apply_others($settings)
    };
}

pub(super) use {also, section};

/// Writes what was given over a key.
pub(super) fn put<K, V: Clone + Into<K>>(key: &mut K, given: Option<&V>) {
    if let Some(value) = given {
        *key = value.clone().into();
    }
}
