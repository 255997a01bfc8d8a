//! All commands, and the help that teaches them.

use crate::assets::Assets;
use crate::environments::bench_env::BenchEnv;
use crate::environments::check_env::CheckEnv;
use crate::environments::info::Info;
use crate::environments::list::List;
use crate::environments::rollout::Rollout;
use crate::environments::run::Run;
use crate::learning::evaluate::Evaluate;
use crate::learning::report::Report;
use crate::learning::sweep::Sweep;
use crate::learning::train::Train;
use crate::models::bench::Bench;
use crate::models::check::Check;
use crate::models::compile::Compile;
use crate::models::convert::Convert;
use crate::models::identify::Identify;
use crate::models::inspect::Inspect;
use crate::models::sim::Sim;
use crate::models::trace::Trace;
use crate::pictures::bench_render::BenchRender;
use crate::pictures::gallery::Gallery;
use crate::pictures::render::Render;
use crate::recordings::data::Data;
use crate::robots::hardware::Hardware;
use crate::robots::wire::Wire;
use crate::shell::completions::Completions;
use crate::shell::man::Man;
use crate::teleop::Teleop;
use crate::version::VERSION;
use crate::view::View;
use crate::web::Web;
use clap::{Parser, Subcommand};

/// Robots described in MJCF, moved as MuJoCo 3.12 moves them.
#[derive(Parser)]
#[command(
    name = "robohive",
    version = VERSION,
    max_term_width = 100,
    after_help = "Exit codes: 0 done; 1 the work failed or a comparison disagreed; 2 wrong arguments \
or input; 130 interrupted by Ctrl-C (128 + the signal).

Examples:
  robohive inspect assets/franka/franka_table.xml
  robohive sim assets/pile/pile.xml --seconds 2 --out pile.npz
  robohive check assets/elbow/elbow.xml validation/reference/own/elbow.npz"
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Subcommand)]
pub enum Command {
    /// List environments
    List(List),
    /// Describe an environment: spaces, rewards, model
    Info(Info),
    /// Play episodes of an environment
    Run(Run),
    /// Learn a policy from episodes of an environment
    Train(Train),
    /// Train over settings and seeds, several runs at a time
    Sweep(Sweep),
    /// Say how often a policy succeeds, beside zero and random actions
    Evaluate(Evaluate),
    /// Say what several runs reached, with 95 % intervals over seeds
    Report(Report),
    /// Drive an environment by hand, and record demonstrations
    Teleop(Box<Teleop>),
    /// Draw a model or an environment
    Render(Render),
    /// Draw many environments on one sheet
    Gallery(Gallery),
    /// Replay recorded actions or states in an environment
    Rollout(Rollout),
    /// Measure environment steps per second
    BenchEnv(BenchEnv),
    /// Measure how long pictures of a model take
    BenchRender(BenchRender),
    /// Check that environments keep their contract
    CheckEnv(CheckEnv),
    /// Summarise a model, or write out every compiled array
    Inspect(Inspect),
    /// Compile a model into one file that loads in milliseconds
    Compile(Compile),
    /// Write a model as one MJCF file that compiles to the same arrays
    Convert(Convert),
    /// Simulate a model under the controls of a keyframe, or none
    Sim(Sim),
    /// Find parameters of a model with which it reads what a log has
    Identify(Identify),
    /// Step or forward recorded inputs and write the named fields
    Trace(Trace),
    /// Compare a model with what MuJoCo recorded of it
    Check(Check),
    /// Measure steps per second
    Bench(Bench),
    /// Look at a model in a window, run it, pull it
    View(View),
    /// Look at models and environments in a browser of this machine
    Web(Web),
    /// Look at a robot's devices: which there are, how they answer, what they measure
    Hardware(Hardware),
    /// Serve simulated devices on pseudo-terminals
    Wire(Wire),
    /// Keep the model files of RoboHive: import, list and verify them
    Assets(Assets),
    /// Look into recordings of episodes, repair them, convert them
    Data(Data),
    /// Print completions for a shell
    Completions(Completions),
    /// Print or write manual pages
    Man(Man),
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    /// The example command lines of a help text, as words; what follows a pipe, a redirection or three blanks is no part.
    fn examples(help: &str) -> Vec<Vec<String>> {
        let (_, examples) = help.split_once("Examples:\n").expect("a section of examples");
        let commands = examples.replace("\\\n", " ");
        let command = |line: &str| {
            let end = ["   ", " | ", " > ", " < "].iter().filter_map(|mark| line.find(mark)).min();
            line[..end.unwrap_or(line.len())].split_whitespace().map(str::to_owned).collect()
        };
        commands
            .lines()
            .filter(|line| line.starts_with("  robohive "))
            .map(|line| command(line.trim_start()))
            .collect()
    }

    #[test]
    fn definitions_are_consistent_and_every_example_parses() {
        let mut main = Arguments::command();
        main.clone().debug_assert();
        main.build();
        let own = |command: &clap::Command| command.get_name() != "help";
        let subcommands: Vec<_> = main.get_subcommands().filter(|c| own(c)).collect();
        assert!(subcommands.len() >= 8);
        for command in subcommands {
            let name = command.get_name();
            let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            let examples = examples(&help);
            assert!(examples.iter().any(|words| words[1] == name), "{name} has no example");
            for words in examples {
                if let Err(error) = Arguments::try_parse_from(&words) {
                    panic!("{name}: {words:?}: {error}");
                }
            }
        }
    }
}
