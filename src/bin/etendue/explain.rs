//! `etendue explain SCENE`: what will be computed, what is left out, and why.

use etendue::plan::{Plan, PlanOptions};
use etendue::scene::Scene;

use crate::{Failure, disk, print};

/// What will be computed, what is left out, and why.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file.
    scene: String,
    #[command(flatten)]
    options: Options,
    /// The folder that no file may lie outside of; by default the one that holds `scenes/` and `sensors/`, else the scene's own.
    #[arg(long, value_name = "DIR")]
    root: Option<String>,
}

/// How to plan.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Leave nothing out: every term by rays.
    #[arg(long)]
    naive: bool,
    /// Switch a rule off; may be given more than once.
    #[arg(long, value_name = "RULE")]
    without: Vec<String>,
}

impl Options {
    pub(crate) fn options(&self) -> PlanOptions {
        PlanOptions { naive: self.naive, without: self.without.clone() }
    }

    pub(crate) fn plan(&self, scene: &Scene) -> Result<Plan, Failure> {
        Plan::new(scene, &self.options()).map_err(|e| match e {
            etendue::plan::PlanError::UnknownRule { .. } => Failure::Input(format!("error: {e}")),
            etendue::plan::PlanError::NotAPartition { .. } => Failure::Run(format!("error: {e}")),
        })
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = disk::scene(&arguments.scene, arguments.root.as_deref())?;
    let plan = arguments.options.plan(&scene)?;
    print(&format!("{}\n{}", scene.title, plan.explain(&scene)))
}
