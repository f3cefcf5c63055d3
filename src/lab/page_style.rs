//! The style that all pages of the lab share: light and dark, on wide and on narrow screens. Content that is wider than
//! the screen scrolls separately.

/// The style that precedes the style of a page. Plots are drawn for white paper; in dark mode they are inverted,
/// keeping their hues.
pub(crate) const PAGE: &str = "
:root { color-scheme: light dark; --ink: #23262d; --paper: #fff; --quiet: #646a75; --line: #d8dbe0; --rule: #e6e8ec; --head: #f4f5f7; --group: #fafbfc;
 --bad: #a3131f; --wrong: #fdecee; --best: #fff3c9; --link: #0b57c2 }
@media (prefers-color-scheme: dark) {
 :root { --ink: #dfe2e8; --paper: #1a1a1a; --quiet: #9aa0ab; --line: #3a3d44; --rule: #2e3138; --head: #25272c; --group: #202226;
  --bad: #ff8d8d; --wrong: #3d2124; --best: #4a3f12; --link: #8ab4ff }
 svg { filter: invert(.898) hue-rotate(180deg) }
}
body { font: 15px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper); max-width: 1280px; margin: 2rem auto; padding: 0 1rem;
 overflow-wrap: anywhere }
a { color: var(--link) }
h1 { font-size: 1.7rem } h2 { margin-top: 3rem; border-top: 1px solid var(--line); padding-top: 1.5rem }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; width: 100% }
small, .quiet { color: var(--quiet) } svg { display: block; max-width: 100%; height: auto }
.wide { overflow-x: auto; margin: 1rem 0 } details { margin: 1rem 0 } summary { cursor: pointer }
";
