//! Parsing the command line in the course's spelling.

use super::general::HEADING;
use super::{dashes, output};
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command, Parser};
use std::ffi::OsString;
use std::fmt::Write;

/// Options, and what is worth telling about them.
#[derive(Clone, Debug)]
pub struct Parsed<T> {
    /// The options.
    pub options: T,
    /// Texts for [`super::warn`].
    pub warnings: Vec<String>,
    /// The options in force, one a line, if `-verbose` is among them.
    pub echo: Option<String>,
    /// Whether `-quiet` is among the options.
    pub quiet: bool,
}

/// Why parsing ends the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stop {
    /// Exit code: 0 after help or version, 2 after a usage error.
    pub code: u8,
    /// Text to print, to stdout if the code is 0, else to stderr.
    pub text: String,
}

/// Parses the process's arguments. Prints warnings, and with `-verbose` the options in force.
/// Ends the process with code 0 after `-help` or `-version`, and with 2 after a usage error.
pub fn parse<T: Parser>() -> T {
    match try_parse_from::<T>(std::env::args_os()) {
        Ok(parsed) => {
            output::set_quiet(parsed.quiet);
            parsed.warnings.iter().for_each(|text| output::warn(text));
            parsed.echo.iter().for_each(|text| output::note(text));
            parsed.options
        }
        Err(stop) => {
            let text = stop.text.trim_end();
            if stop.code == 0 {
                output::say(text);
            } else {
                output::complain(text);
            }
            std::process::exit(stop.code.into());
        }
    }
}

/// Parses arguments, the program's name first. Flags have one dash or two; a flag given twice
/// counts the last time, with a warning.
///
/// # Errors
/// [`Stop`] with the text of the help or the usage error, in the course's spelling.
pub fn try_parse_from<T: Parser>(
    args: impl IntoIterator<Item = impl Into<OsString>>,
) -> Result<Parsed<T>, Stop> {
    let args = dashes::doubled(args.into_iter().map(Into::into));
    let mut command = prepared(T::command());
    let warnings = repeated_flags(&command, &args);
    let matches = command.try_get_matches_from_mut(args).map_err(stop)?;
    let options = T::from_arg_matches(&matches).map_err(|error| stop(error.format(&mut command)))?;
    Ok(Parsed {
        options,
        warnings,
        echo: is_set(&matches, "verbose").then(|| echo(&command, &matches)),
        quiet: is_set(&matches, "quiet"),
    })
}

fn stop(error: clap::Error) -> Stop {
    Stop { code: if error.use_stderr() { 2 } else { 0 }, text: dashes::singled(&error.to_string()) }
}

/// The settings that all programs share.
fn prepared(command: Command) -> Command {
    command
        .args_override_self(true)
        .disable_help_flag(true)
        .disable_version_flag(true)
        .mut_args(|arg| if takes_value(&arg) { with_values(arg) } else { arg })
        .arg(flag("help", 'h', "Print this help").action(ArgAction::Help))
        .arg(flag("version", 'V', "Print the version").action(ArgAction::Version))
}

fn flag(name: &'static str, short: char, help: &'static str) -> Arg {
    Arg::new(name).short(short).long(name).help(help).help_heading(HEADING)
}

fn with_values(arg: Arg) -> Arg {
    let arg = arg.allow_negative_numbers(true);
    // `-size 1 1 -size 2 2` must not collect four values; repeatable flags take one at a time.
    let fixed = arg.get_num_args().is_some_and(|range| range.min_values() > 1);
    if fixed { arg.action(ArgAction::Set) } else { arg }
}

fn takes_value(arg: &Arg) -> bool {
    matches!(arg.get_action(), ArgAction::Set | ArgAction::Append)
}

/// A warning for every flag that is given more than once without being made for it.
fn repeated_flags(command: &Command, args: &[OsString]) -> Vec<String> {
    let times = |long: &str| {
        args.iter()
            .skip(1)
            .take_while(|arg| *arg != "--")
            .filter_map(|arg| arg.to_str()?.strip_prefix("--"))
            .filter(|arg| arg.split('=').next() == Some(long))
            .count()
    };
    command
        .get_arguments()
        .filter(|arg| matches!(arg.get_action(), ArgAction::Set | ArgAction::SetTrue))
        .filter_map(|arg| arg.get_long())
        .filter(|long| times(long) > 1)
        .map(|long| format!("-{long} is given {} times; the last one counts", times(long)))
        .collect()
}

fn is_set(matches: &ArgMatches, id: &str) -> bool {
    matches!(matches.try_get_one(id), Ok(Some(true)))
}

/// The options in force, one a line, as they could be typed.
fn echo(command: &Command, matches: &ArgMatches) -> String {
    let mut text = "options in force:".to_owned();
    for arg in command.get_arguments() {
        let id = arg.get_id().as_str();
        let Some(source) = matches.value_source(id) else {
            continue;
        };
        let switch = !takes_value(arg);
        if switch && !is_set(matches, id) {
            continue;
        }
        let _ = write!(text, "\n  -{}", arg.get_long().unwrap_or(id));
        if !switch {
            for value in matches.get_raw(id).into_iter().flatten() {
                let _ = write!(text, " {}", value.to_string_lossy());
            }
        }
        if source == ValueSource::DefaultValue {
            text.push_str("  (default)");
        }
    }
    text
}
