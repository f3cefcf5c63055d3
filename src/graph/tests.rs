//! Tests of the planner's rules, without a device.

use super::{
    Carried, Changes, ChannelFacts, FramePlan, PassFacts, ReadTiming, Target, TexelSource, TilingError,
    effective_sampler,
};
use eddy_project::{
    Body, Channel, Dialect, Filter, Group, Input, MAX_CHANNELS, Origin, Pass, PassName, PassSize, Project, Region,
    Sampler, SamplerRules, Wrap,
};
use eddy_texture::{Dimension, TexelFormat};

const LETTERS: [&str; 4] = ["A", "B", "C", "D"];

fn channel(input: Input, filter: Filter, wrap: Wrap) -> Option<Channel> {
    Some(Channel { input, sampler: Sampler { filter, wrap, vflip: true } })
}

fn buffer(name: &str) -> Option<Channel> {
    channel(Input::buffer(name), Filter::Linear, Wrap::Clamp)
}

fn pass(id: PassName, channels: [Option<Channel>; 4]) -> Pass {
    Pass { bindings: channels.into(), ..Pass::new(id.clone(), source(&id)) }
}

fn source(id: &PassName) -> eddy_project::Source {
    eddy_project::Source { name: id.title(), path: None, text: "".into() }
}

fn project(passes: Vec<Pass>) -> Project {
    Project::new("test", passes, Origin::Unsaved)
}

fn reads_all() -> PassFacts {
    PassFacts {
        channels: [ChannelFacts { is_read: true, reaches_mips: true, max_texels: None }; MAX_CHANNELS],
        discards: false,
    }
}

fn plan(project: &Project) -> FramePlan {
    FramePlan::new(project, &vec![reads_all(); project.passes.len()], &[], true)
}

/// Returns what `reader`'s channel `c` reads in `plan`: the target's title and the frame.
fn seen(project: &Project, plan: &FramePlan, reader: &PassName, c: usize) -> Option<(String, ReadTiming)> {
    let draw = plan.draws.iter().find(|d| project.passes[d.pass].id == *reader)?;
    match &draw.reads[c].as_ref()?.source {
        TexelSource::Target { index, when } => Some((plan.targets[*index].id.title(), *when)),
        _ => None,
    }
}

#[test]
fn truth_table_of_reads() {
    // Every buffer and Image read all four buffers; the buffers are not listed in alphabetical order.
    for order in [[0, 1, 2, 3], [3, 1, 0, 2], [2, 3, 0, 1]] {
        let everything = || LETTERS.map(buffer);
        let mut passes: Vec<_> = order.map(|i| pass(PassName::buffer(LETTERS[i]), everything())).into_iter().collect();
        passes.push(pass(PassName::image(), everything()));
        let project = project(passes);
        let plan = plan(&project);
        for (place, &reader) in order.iter().enumerate() {
            for (source, letter) in LETTERS.iter().enumerate() {
                let source_place = order.iter().position(|&i| i == source).unwrap();
                let when = if source_place < place { ReadTiming::ThisFrame } else { ReadTiming::LastFrame };
                let id = PassName::buffer(LETTERS[reader]);
                assert_eq!(seen(&project, &plan, &id, source), Some((format!("Buffer {letter}"), when)), "{order:?}");
            }
        }
        for (source, letter) in LETTERS.iter().enumerate() {
            let expected = Some((format!("Buffer {letter}"), ReadTiming::ThisFrame));
            assert_eq!(seen(&project, &plan, &PassName::image(), source), expected);
        }
    }
}

#[test]
fn buffers_see_last_frames_cubemap_and_image_this_frames() {
    let cube = || channel(Input::pass(PassName::cube()), Filter::Linear, Wrap::Clamp);
    let project = project(vec![
        pass(PassName::buffer("A"), [cube(), None, None, None]),
        pass(PassName::cube(), [buffer("A"), cube(), None, None]),
        pass(PassName::image(), [cube(), buffer("A"), None, None]),
    ]);
    let plan = plan(&project);
    let see = |id: PassName, c| seen(&project, &plan, &id, c).unwrap().1;
    assert_eq!(see(PassName::buffer("A"), 0), ReadTiming::LastFrame);
    assert_eq!(see(PassName::cube(), 0), ReadTiming::ThisFrame);
    assert_eq!(see(PassName::cube(), 1), ReadTiming::LastFrame);
    assert_eq!(see(PassName::image(), 0), ReadTiming::ThisFrame);
    assert_eq!(plan.targets.iter().find(|t| t.id.has_faces()).unwrap().dimension, Dimension::Cube);
}

#[test]
fn unreachable_passes_are_not_drawn_and_unread_channels_reach_nothing() {
    let project = project(vec![
        pass(PassName::buffer("A"), [None, None, None, None]),
        pass(PassName::buffer("B"), [buffer("A"), None, None, None]),
        pass(PassName::image(), [buffer("B"), buffer("A"), None, None]),
    ]);
    let mut facts = vec![reads_all(); 3];
    facts[2].channels[0].is_read = false;
    let plan = FramePlan::new(&project, &facts, &[], true);
    assert_eq!(plan.draws.iter().map(|d| d.pass).collect::<Vec<_>>(), [0, 2], "Image only names B");
    assert_eq!(plan.skipped, [1]);
    let all = FramePlan::new(&project, &facts, &[], false);
    assert_eq!(all.draws.len(), 3);
    assert!(all.skipped.is_empty());
    let wanted = FramePlan::new(&project, &facts, &[PassName::buffer("B")], true);
    assert_eq!(wanted.draws.iter().map(|d| d.pass).collect::<Vec<_>>(), [0, 1], "Image is not wanted");
}

#[test]
fn only_buffers_read_back_or_discarded_are_doubled() {
    let project = project(vec![
        pass(PassName::buffer("A"), [buffer("C"), None, None, None]),
        pass(PassName::buffer("B"), [buffer("A"), None, None, None]),
        pass(PassName::buffer("C"), [buffer("B"), None, None, None]),
        pass(PassName::buffer("D"), [None, None, None, None]),
        pass(PassName::image(), [buffer("C"), buffer("D"), None, None]),
    ]);
    let doubled = |facts: &[PassFacts], skip| {
        let plan = FramePlan::new(&project, facts, &[], skip);
        plan.targets.iter().filter(|t| t.doubled).map(|t| t.id.key().to_owned()).collect::<Vec<_>>()
    };
    let mut facts = vec![reads_all(); 5];
    assert_eq!(doubled(&facts, true), ["buffer_c"]);
    facts[3].discards = true;
    assert_eq!(doubled(&facts, true), ["buffer_c", "buffer_d"], "discard shows what lay there two frames ago");
    facts[4].discards = true;
    assert!(!doubled(&facts, false).contains(&"image".to_string()), "Image keeps one canvas");
    assert_eq!(doubled(&facts, false).len(), 4);
}

#[test]
fn mips_exist_only_where_a_sampler_asks_and_a_read_can_reach_them() {
    let mip = |name: &str| channel(Input::buffer(name), Filter::Mipmap, Wrap::Clamp);
    let project = project(vec![
        pass(PassName::buffer("A"), [None, None, None, None]),
        pass(PassName::buffer("B"), [None, None, None, None]),
        pass(PassName::image(), [mip("A"), buffer("A"), buffer("B"), None]),
    ]);
    let mut facts = vec![reads_all(); 3];
    let mips = |facts: &[PassFacts]| {
        let plan = FramePlan::new(&project, facts, &[], true);
        let image = plan.draws.last().unwrap().reads.clone();
        let channels: Vec<usize> = (0..image.len()).filter(|c| image[*c].as_ref().is_some_and(|r| r.mips)).collect();
        (plan.targets.iter().map(|t| t.mips).collect::<Vec<_>>(), channels)
    };
    assert_eq!(mips(&facts), (vec![true, false, false], vec![0]));
    facts[2].channels[0].reaches_mips = false;
    facts[2].channels[1].reaches_mips = false;
    assert_eq!(mips(&facts).0, [false, false, false]);
}

#[test]
fn site_rules_share_filter_in_a_pass_and_wrap_in_the_project() {
    let a = |filter, wrap| channel(Input::buffer("A"), filter, wrap);
    let mut project = project(vec![
        pass(PassName::buffer("A"), [a(Filter::Nearest, Wrap::Clamp), None, None, None]),
        pass(PassName::image(), [a(Filter::Nearest, Wrap::Clamp), a(Filter::Linear, Wrap::Repeat), None, None]),
    ]);
    let sampler = |project: &Project, p, c| {
        let s = effective_sampler(project, p, c).unwrap();
        (s.filter, s.wrap)
    };
    assert_eq!(sampler(&project, 1, 0), (Filter::Nearest, Wrap::Clamp));
    project.sampler_rules = SamplerRules::Site;
    assert_eq!(sampler(&project, 1, 0), (Filter::Linear, Wrap::Repeat));
    assert_eq!(sampler(&project, 0, 0), (Filter::Nearest, Wrap::Repeat));
}

#[test]
fn keyboard_is_nearest_and_clamped_whatever_the_project_says() {
    let project = project(vec![pass(
        PassName::image(),
        [channel(Input::KEYBOARD, Filter::Linear, Wrap::Repeat), None, None, None],
    )]);
    let read = plan(&project).draws[0].reads[0].clone().unwrap();
    assert_eq!(
        (read.sampler.filter, read.sampler.wrap, read.source),
        (Filter::Nearest, Wrap::Clamp, TexelSource::External)
    );
}

#[test]
fn a_buffer_without_a_pass_is_a_target_without_a_draw() {
    let project = project(vec![pass(PassName::image(), [buffer("C"), None, None, None])]);
    let plan = plan(&project);
    let place = plan.targets.iter().position(|t| t.id == PassName::buffer("C")).unwrap();
    assert!(!plan.targets[place].doubled && plan.draws.iter().all(|draw| !draw.targets.contains(&place)));
}

fn id(letter: &str) -> PassName {
    PassName::buffer(letter)
}

#[test]
fn a_group_is_one_run_of_many_steps_and_every_other_draw_a_run_of_one() {
    let mut project = project(vec![
        pass(id("A"), Default::default()),
        pass(id("B"), [buffer("C"), buffer("A"), None, None]),
        pass(id("C"), [buffer("B"), None, None, None]),
        pass(id("D"), Default::default()),
        pass(PassName::image(), [buffer("C"), buffer("D"), None, None]),
    ]);
    project.groups = vec![Group { name: "solver".into(), passes: vec![id("B"), id("C")], steps: 20 }];
    let runs = |plan: &FramePlan| plan.runs.iter().map(|r| (r.draws.clone(), r.steps)).collect::<Vec<_>>();
    let whole = plan(&project);
    assert_eq!(runs(&whole), [(0..1, 1), (1..3, 20), (3..4, 1), (4..5, 1)]);
    assert_eq!(whole.draws_per_frame(), 43);
    let mut facts = vec![reads_all(); 5];
    facts[4].channels[0].is_read = false;
    let less = FramePlan::new(&project, &facts, &[], true);
    assert_eq!(
        (runs(&less), less.draws_per_frame()),
        (vec![(0..1, 1), (1..2, 1)], 2),
        "what nobody reaches has no steps"
    );
}

#[test]
fn targets_have_their_passes_sizes_formats_and_regions() {
    let mut project = project(vec![
        pass(id("A"), Default::default()),
        pass(PassName::image(), [buffer("A"), buffer("D"), None, None]),
    ]);
    let region = Region { x: 3, y: 1, width: 9, height: 2 };
    let settings = &mut project.passes[0].settings;
    (settings.size, settings.format, settings.region) = (PassSize::Scale(0.5), TexelFormat::Rg16f, Some(region));
    let plan = plan(&project);
    assert_eq!((plan.targets[0].size, plan.targets[0].format), (PassSize::Scale(0.5), TexelFormat::Rg16f));
    assert_eq!((plan.draws[0].region, plan.draws[0].keeps_content), (Some(region), true));
    assert_eq!((plan.targets[2].size, plan.draws[1].keeps_content), (PassSize::Canvas, false), "D, which has no pass");
    assert_eq!([(7, 5), (1, 1)].map(|c| PassSize::Scale(0.5).of(c)), [(4, 3), (1, 1)]);
    assert_eq!(PassSize::Fixed(2, 3).of((7, 5)), (2, 3));
    assert_eq!(region.within((8, 2)), Some(Region { width: 5, height: 1, ..region }));
    assert_eq!(region.within((3, 9)), None);
}

#[test]
fn only_draws_that_do_not_read_themselves_are_cached() {
    let project = project(vec![
        pass(id("A"), Default::default()),
        pass(id("B"), [buffer("B"), None, None, None]),
        pass(id("C"), Default::default()),
        pass(PassName::image(), [buffer("A"), buffer("B"), buffer("C"), None]),
    ]);
    let mut facts = vec![reads_all(); 4];
    facts[2].discards = true;
    let rests =
        |skip| FramePlan::new(&project, &facts, &[], skip).draws.iter().map(|d| d.is_cacheable).collect::<Vec<_>>();
    assert_eq!(rests(true), [true, false, false, true]);
    assert_eq!(rests(false), [false; 4], "--no-skip draws everything");
}

#[test]
fn a_draw_is_skipped_until_one_of_its_transitive_inputs_changes() {
    // A -> B -> Image, and C reads the same sources as Image, but of the previous frame.
    let project = project(vec![
        pass(id("C"), [buffer("B"), None, None, None]),
        pass(id("A"), Default::default()),
        pass(id("B"), [buffer("A"), None, None, None]),
        pass(PassName::image(), [buffer("B"), buffer("C"), None, None]),
    ]);
    let plan = plan(&project);
    let mut changes = Changes::new(&plan);
    let frame = |changes: &mut Changes, inputs: [u8; 4]| -> String {
        let due = |(i, draw)| {
            changes
                .must_draw(i, draw, &draw.dependencies(), &inputs[i..=i])
                .then(|| project.passes[plan.draws[i].pass].id.title())
        };
        let titles: Vec<String> = plan.draws.iter().enumerate().filter_map(due).collect();
        titles.iter().map(|t| t.chars().last().unwrap()).collect()
    };
    assert_eq!(frame(&mut changes, [0; 4]), "CABe");
    assert_eq!(frame(&mut changes, [0; 4]), "Ce", "C sees the B of the frame before");
    assert_eq!(frame(&mut changes, [0; 4]), "");
    assert_eq!(frame(&mut changes, [0, 1, 0, 0]), "ABe", "A's uniform");
    assert_eq!(frame(&mut changes, [0, 1, 0, 0]), "Ce");
    assert_eq!(frame(&mut changes, [0, 1, 0, 7]), "e");
    changes.invalidate();
    assert_eq!(frame(&mut changes, [0, 1, 0, 7]), "CABe");
}

/// `scene` draws meshes into two targets and may discard; A reads its second, Image reads A and its first.
fn with_scene() -> (Project, Vec<PassFacts>) {
    let id = PassName::buffer("scene");
    let mut scene = pass(id, Default::default());
    scene.settings.format = TexelFormat::Rgba8;
    scene.body = Body::Meshes(eddy_project::Geometry {
        draws: Vec::new(),
        more_targets: vec![TexelFormat::Rgba16f],
        camera: Default::default(),
        stages: Vec::new(),
    });
    let second = channel(Input::Pass { id: PassName::buffer("scene"), target: 1 }, Filter::Mipmap, Wrap::Clamp);
    let a = pass(PassName::buffer("A"), [second, None, None, None]);
    let image = pass(PassName::image(), [buffer("scene"), buffer("A"), None, None]);
    let nothing = PassFacts { discards: true, ..PassFacts::default() };
    (project(vec![scene, a, image]), vec![nothing, reads_all(), reads_all()])
}

#[test]
fn a_scene_has_a_target_for_each_of_its_pictures() {
    let (project, facts) = with_scene();
    let plan = FramePlan::new(&project, &facts, &[], true);
    let targets: Vec<_> = plan.targets.iter().map(|t| (t.id.key(), t.index, t.format, t.mips, t.doubled)).collect();
    let scene = || "buffer_scene";
    // Cleared first, so that a `discard` never shows older texels; mips only for the target whose sampler uses them.
    assert_eq!(
        targets[..2],
        [(scene(), 0, TexelFormat::Rgba8, false, false), (scene(), 1, TexelFormat::Rgba16f, true, false)]
    );
    assert_eq!(plan.draws[0].targets, 0..2);
    assert!(!plan.draws[0].keeps_content && plan.draws[0].is_cacheable);
    let read = |draw: usize, c: usize| plan.draws[draw].reads[c].as_ref().unwrap().source.clone();
    assert_eq!(read(1, 0), TexelSource::Target { index: 1, when: ReadTiming::ThisFrame });
    assert_eq!(read(2, 0), TexelSource::Target { index: 0, when: ReadTiming::ThisFrame });
    // Without skipping it is drawn each frame, and still cleared.
    let full = FramePlan::new(&project, &facts, &[], false);
    assert!(!full.draws[0].keeps_content && !full.draws[0].is_cacheable);
}

#[test]
fn readers_of_any_target_follow_a_scene_that_was_drawn() {
    let (project, facts) = with_scene();
    let plan = FramePlan::new(&project, &facts, &[], true);
    let mut changes = Changes::new(&plan);
    let mut due = |camera: &[u8]| -> Vec<bool> {
        let inputs = [camera, b"", b""];
        plan.draws.iter().enumerate().map(|(i, d)| changes.must_draw(i, d, &d.dependencies(), inputs[i])).collect()
    };
    assert_eq!(due(b"here"), [true; 3]);
    assert_eq!(due(b"here"), [false; 3]);
    assert_eq!(due(b"there"), [true; 3], "A reads the second target and is drawn again");
}

#[test]
fn a_missing_target_reads_as_nothing() {
    let (mut project, facts) = with_scene();
    let fourth = channel(Input::Pass { id: PassName::buffer("scene"), target: 3 }, Filter::Linear, Wrap::Clamp);
    project.passes[1].bindings.set(0, fourth);
    let plan = FramePlan::new(&project, &facts, &[], true);
    assert_eq!(plan.draws[1].reads[0].as_ref().unwrap().source, TexelSource::Nothing);
}

#[test]
fn traffic_counts_writes_and_each_source_once_per_draw() {
    let frame = |change: &dyn Fn(&mut Project)| {
        let a = pass(id("A"), [buffer("A"), buffer("A"), buffer("B"), None]);
        let b = pass(id("B"), [buffer("A"), None, None, None]);
        let mut project = project(vec![a, b, pass(PassName::image(), [buffer("B"), None, None, None])]);
        change(&mut project);
        let plan = FramePlan::new(&project, &[reads_all(); 3], &[id("B")], true);
        let traffic = plan.traffic((8, 4));
        (traffic.bytes / 32, traffic.texels)
    };
    // A: itself once, B, and a write; B: A and a write.
    assert_eq!(frame(&|_| ()), (16 * 5, 64));
    assert_eq!(frame(&|p| p.passes[0].settings.format = TexelFormat::R16f), (2 * 3 + 16 * 2, 64));
    let group = Group { name: "g".into(), passes: vec![id("A")], steps: 3 };
    assert_eq!(frame(&|p| p.groups.push(group.clone())), (16 * (3 * 3 + 2), 128));
    let part = Region { x: 0, y: 0, width: 4, height: 4 };
    assert_eq!(frame(&|p| p.passes[1].settings.region = Some(part)), (16 * 3 + 16, 48));
}

#[test]
fn an_additional_output_changes_no_other_target() {
    let project = project(vec![
        pass(PassName::buffer("A"), [buffer("A"), None, None, None]),
        pass(PassName::image(), [buffer("A"), None, None, None]),
    ]);
    let plain = plan(&project);
    let mut plan = plan(&project);
    let value = PassName::buffer("a value");
    plan.add_extra_target(0, value.clone());
    assert_eq!(plan.targets[..plain.targets.len()], plain.targets);
    let [more] = &plan.targets[plain.targets.len()..] else { panic!("one more target") };
    assert_eq!((&more.id, more.index, more.format, more.doubled), (&value, 0, TexelFormat::Rgba32f, false));
    assert!(plan.is_drawn(plain.targets.len()));
    let drawn: Vec<Vec<usize>> = plan.draws.iter().map(|draw| draw.all_targets().collect()).collect();
    assert_eq!((drawn, plan.draws_per_frame()), (vec![vec![0, 2], vec![1]], 2));
    assert_eq!(plan.draws[0].reads, plain.draws[0].reads);
}

#[test]
fn targets_that_are_read_before_being_overwritten_are_carried_to_the_next_frame() {
    // A reads C of the previous frame, B reads A, C reads B and its own previous picture; D shows its own previous
    // picture.
    let project = project(vec![
        pass(id("A"), [buffer("C"), None, None, None]),
        pass(id("B"), [buffer("A"), None, None, None]),
        pass(id("C"), [buffer("B"), buffer("C"), None, None]),
        pass(id("D"), [buffer("E"), None, None, None]),
        pass(PassName::image(), [buffer("C"), buffer("D"), None, None]),
    ]);
    let mut facts = vec![reads_all(); 5];
    facts[3].discards = true;
    let carried = |project: &Project, facts: &[PassFacts], skip| {
        let plan = FramePlan::new(project, facts, &[], skip);
        let of = |(index, target): (usize, &Target)| (target.id.title(), plan.carried(index));
        plan.targets.iter().enumerate().map(of).collect::<std::collections::BTreeMap<_, _>>()
    };
    let expect = |entries: [Carried; 6]| {
        let ids = ["A", "B", "C", "D", "E"].map(id).into_iter().chain([PassName::image()]);
        ids.map(|id| id.title()).zip(entries).collect::<std::collections::BTreeMap<_, _>>()
    };
    let (nothing, newest, all) = (Carried::Nothing, Carried::Newest, Carried::All);
    // E is not drawn.
    assert_eq!(carried(&project, &facts, true), expect([nothing, nothing, newest, all, nothing, nothing]));
    assert_eq!(carried(&project, &facts, false), expect([all, all, all, all, nothing, newest]));
    // Image has one texture, which a `discard` shows.
    facts[4].discards = true;
    assert_eq!(carried(&project, &facts, true)[&PassName::image().title()], newest);
    // The texels around a region never change.
    let mut project = project;
    project.passes[0].settings.region = Some(Region { x: 0, y: 0, width: 3, height: 3 });
    project.passes[3].settings.region = project.passes[0].settings.region;
    assert_eq!(carried(&project, &facts, true), expect([newest, nothing, newest, newest, nothing, newest]));
}

#[test]
fn later_frames_depend_on_their_transitive_inputs() {
    // A is read by B in its own frame, B by itself in the next; C shows B, and Image shows C.
    let mut project = project(vec![
        pass(id("A"), [None, None, None, None]),
        pass(id("B"), [buffer("A"), buffer("B"), None, None]),
        pass(id("C"), [buffer("B"), None, None, None]),
        pass(PassName::image(), [buffer("C"), None, None, None]),
    ]);
    let mut facts = vec![reads_all(); 4];
    let lasting = |project: &Project, facts: &[PassFacts]| FramePlan::new(project, facts, &[], true).lasting_draws();
    assert_eq!(lasting(&project, &facts), [true, true, false, false]);
    // A `discard` shows the previous content.
    facts[2].discards = true;
    assert_eq!(lasting(&project, &facts), [true, true, true, false]);
    facts[2].discards = false;
    // A reads what C left.
    project.passes[0].bindings.set(0, buffer("C"));
    assert_eq!(lasting(&project, &facts), [true, true, true, false]);
    // Nothing is read from a previous frame.
    project.passes[0].bindings.set(0, None);
    project.passes[1].bindings.set(1, None);
    assert_eq!(lasting(&project, &facts), [false; 4]);
}

#[test]
fn the_last_draw_may_be_split_if_the_result_is_the_same() {
    let mut project = project(vec![
        pass(id("A"), [buffer("B"), None, None, None]),
        pass(id("B"), [buffer("A"), None, None, None]),
        pass(PassName::image(), [buffer("A"), None, None, None]),
    ]);
    let facts = [reads_all(); 3];
    let plan =
        |project: &Project, facts: &[PassFacts], wanted: &[PassName]| FramePlan::new(project, facts, wanted, true);
    let divisible = |project: &Project, facts: &[PassFacts]| plan(project, facts, &[]).divisible_draw();
    assert_eq!(divisible(&project, &facts), Some(2));
    assert_eq!(plan(&project, &facts, &[id("B")]).divisible_draw(), None, "A reads the B of the frame before");
    assert_eq!(
        divisible(&project, &[facts[0], facts[1], PassFacts::ANYTHING]),
        None,
        "a `discard` shows what was there"
    );
    let mut probed = plan(&project, &facts, &[]);
    probed.add_extra_target(2, id("probe"));
    assert_eq!(probed.divisible_draw(), None, "a probe is read back");
    project.groups = vec![Group { name: "g".into(), passes: vec![PassName::image()], steps: 2 }];
    assert_eq!(divisible(&project, &facts), None, "it is drawn twice");
    project.groups.clear();
    project.passes[2].settings.region = Some(Region { x: 0, y: 0, width: 3, height: 3 });
    assert_eq!(divisible(&project, &facts), None, "the rest is as it was drawn last");
    assert_eq!(FramePlan::default().divisible_draw(), None);
}

#[test]
fn a_pass_is_drawn_in_tiles_if_its_picture_is_the_same() {
    let image = || pass(PassName::image(), [buffer("A"), None, None, None]);
    let a = || pass(PassName::buffer("A"), Default::default());
    let project = project(vec![a(), image()]);
    let whole = plan(&project);
    let mut tiled = whole.clone();
    tiled.tile(&project, 1, (64, 32)).unwrap();
    let of_image = tiled.tiled.unwrap();
    assert_eq!((of_image.draw, of_image.size), (1, PassSize::Canvas));
    let target = tiled.draws[1].targets.start;
    assert_eq!(tiled.targets[target].size.of((9000, 9000)), (64, 32));
    assert_eq!(tiled.target_bytes((100, 10)), 16 * (100 * 10 + 64 * 32));
    // Everything else is unchanged.
    assert_eq!(FramePlan { tiled: None, targets: whole.targets.clone(), ..tiled }, whole);
    // Buffer A is read by Image.
    let mut refused = whole.clone();
    assert_eq!(refused.tile(&project, 0, (64, 32)), Err(TilingError::Read("Image".into())));
    assert_eq!(refused, whole);
}

#[test]
fn a_pass_whose_picture_would_differ_is_not_drawn_in_tiles() {
    let why = |passes: Vec<Pass>, facts: PassFacts, of: usize| {
        let project = project(passes);
        let wanted = [project.passes[of].id.clone()];
        let mut plan = FramePlan::new(&project, &vec![facts; project.passes.len()], &wanted, true);
        plan.tile(&project, of, (64, 32)).unwrap_err()
    };
    let image = || pass(PassName::image(), Default::default());
    let a = || pass(PassName::buffer("A"), [buffer("A"), None, None, None]);
    let region = Some(Region { x: 0, y: 0, width: 1, height: 1 });
    let settings = |region| eddy_project::PassSettings { region, ..Default::default() };
    assert_eq!(why(vec![image()], PassFacts { discards: true, ..reads_all() }, 0), TilingError::Discards);
    assert_eq!(why(vec![a(), image()], reads_all(), 0), TilingError::Itself);
    assert_eq!(why(vec![Pass { settings: settings(region), ..image() }], reads_all(), 0), TilingError::Region);
    assert_eq!(why(vec![pass(PassName::cube(), Default::default()), image()], reads_all(), 0), TilingError::Cube);
}

#[test]
fn readers_in_any_channel_follow_a_buffer_that_was_drawn() {
    for slot in [3, 4, MAX_CHANNELS - 1] {
        let mut image = pass(PassName::image(), [None, None, None, None]);
        image.bindings.set(slot, buffer("A"));
        let project = project(vec![pass(PassName::buffer("A"), [None, None, None, None]), image]);
        let plan = plan(&project);
        let mut changes = Changes::new(&plan);
        let mut due = |key: &[u8]| -> Vec<bool> {
            let inputs = [key, b""];
            plan.draws.iter().enumerate().map(|(i, d)| changes.must_draw(i, d, &d.dependencies(), inputs[i])).collect()
        };
        assert_eq!(due(b"up"), [true; 2]);
        assert_eq!((due(b"up"), due(b"down")), (vec![false; 2], vec![true; 2]), "channel {slot}");
    }
}

#[test]
fn programs_that_clear_their_targets_show_no_earlier_texels() {
    let mut project = project(vec![
        pass(PassName::buffer("A"), [None, None, None, None]),
        pass(PassName::image(), [None, None, None, None]),
    ]);
    let mut facts = vec![reads_all(); 2];
    facts[0].discards = true;
    let plan_of =
        |project: &Project, facts: &[PassFacts]| FramePlan::new(project, facts, &[PassName::buffer("A")], true);
    let kept = plan_of(&project, &facts);
    assert!(kept.draws[0].keeps_content && kept.draws[0].clear.is_none() && !kept.draws[0].is_cacheable);
    project.dialect = Dialect::Twigl;
    let cleared = plan_of(&project, &facts);
    assert_eq!(cleared.draws[0].clear, Some([0.0, 0.0, 0.0, 1.0]));
    assert!(!cleared.draws[0].keeps_content && cleared.draws[0].is_cacheable);
    // Where every texel is drawn, nothing need be cleared.
    facts[0].discards = false;
    assert_eq!(plan_of(&project, &facts).draws[0].clear, None);
}
