//! Owns what the help says besides the keys.

/// A part of the help: a title, and paragraphs. A paragraph that begins with a tab is code.
pub(super) struct Section {
    pub title: &'static str,
    pub paragraphs: &'static [&'static str],
}

/// The section that has a button for the page with the bookmarklet.
pub(super) const SHADERTOY: &str = "Shadertoy";

pub(super) const SECTIONS: &[Section] = &[
    Section {
        title: "First steps",
        paragraphs: &[
            "Open a preset from the gallery, or choose New. Type in the code: Eddy compiles as you type and updates the \
             picture. If there is an error, the last working version keeps running, and the list below the code says \
             what is wrong and where.",
            "Press Ctrl+Shift+P for the command palette, which finds every command by a few letters. Drag the picture \
             to move iMouse; press Alt+Up to play or pause.",
            "Save with Ctrl+S. A project is a folder of plain GLSL files; presets are never changed, as editing one \
             edits a copy. Unsaved work is backed up within a second and offered again after a crash.",
            "You can use another editor at the same time: Eddy reloads a file when it is saved.",
            "Ctrl+comma opens the settings: theme, zoom, code font, word wrap, when to compile, and the slow frame limit.",
        ],
    },
    Section {
        title: "Keyboard",
        paragraphs: &[
            "A blue frame shows which panel has keyboard focus. Click the picture to send keys to the shader, click the \
             code to type.",
            "F6 focuses the next panel, Shift+F6 the previous one. Inside a panel, Tab goes to the next control, Space \
             or Enter presses it, and the arrow keys move a slider. Escape returns to the code or the picture.",
            "Shift+F10 or the menu key opens the menu of a tab. To resize, move or close the focused panel from the \
             keyboard, search the command palette for \"panel\".",
            "In a dialog, Enter presses the highlighted button and Escape cancels.",
        ],
    },
    Section {
        title: SHADERTOY,
        paragraphs: &[
            "Drop or paste the JSON of a shader to open it. The bookmarklet page, which opens in your browser, has a \
             bookmark that saves this JSON from a shader's Shadertoy page.",
            "Export, Shadertoy JSON writes the project in the same form. What Shadertoy does not have, such as sizes of \
             passes, your own uniforms and included files, is listed before the file is written.",
        ],
    },
    Section {
        title: "Exporting and recording",
        paragraphs: &[
            "The Export menu has everything that leaves the window as a file: screenshots, float texels, Shadertoy \
             JSON, recordings of input, measurements and the lab's report.",
            "Record input saves what each frame is given: time, mouse, keys, resolution and uniforms. To play a \
             recording, drop the .replay file on the window or choose Open, Recording. It starts at frame 0 and pauses \
             at its last frame. Your mouse and keys do not reach the picture until then; press Stop to continue live \
             from the shown frame. The command line draws the same frames with --replay.",
        ],
    },
    Section {
        title: "Picture",
        paragraphs: &[
            "iMouse follows the mouse over the picture: xy is the position while the button is held, zw where it was \
             pressed. To read keys, set a channel to Keyboard.",
            "Choose the resolution and the shown pass in the toolbar below the picture. Type any size, like 1080x1920, in \
             the field of the resolution menu; a picture that is larger than the panel is scaled down to fit. The size is \
             remembered with the project. Changing the resolution restarts the buffers. Screenshots are saved in the project's folder, or in your pictures folder if the \
             project is not saved.",
            "If a frame exceeds the time limit, Eddy pauses the picture and asks what to do. Your text is never changed.",
        ],
    },
    Section {
        title: "Passes and channels",
        paragraphs: &[
            "Passes are drawn in the order of their tabs, Image last. Common is shared code, inserted before the code \
             of every pass. Press + to add a pass; right-click a tab to show or remove one.",
            "A pass reads its inputs from iChannel0 to iChannel3: another pass, the keyboard or an image file. A pass \
             that reads itself, or a pass drawn after it, gets the previous frame.",
        ],
    },
    Section {
        title: "Uniforms",
        paragraphs: &[
            "Add a line like one of these to get a slider, which changes the value without compiling:",
            "\t#iUniform float speed = 1.0 in { 0.0, 5.0 }",
            "\t#iUniform color3 tint = color3(1.0, 0.5, 0.0)",
            "Types are float, int, bool, vec2, vec3, vec4 and color3. To set the step of a slider, write step 0.1 after \
             the range.",
            "Drag a slider, or click its number to type a value. Double-click the name or the slider to reset it. \
             Values are saved with the project.",
        ],
    },
    Section {
        title: "Debugging",
        paragraphs: &[
            "Probe draws the value of the expression at the caret instead of the picture. The bar above it shows the \
             range, a histogram and the value under the mouse. Stripes mark pixels that do not evaluate the expression. \
             Press Escape to close the probe. Hold Ctrl+Alt to probe the expression under the mouse. Buffers keep \
             running.",
            "Trace steps through the code of one pixel, line by line. Ctrl+Shift+click a pixel of the picture to start. \
             Use the usual debugger keys to step forwards, and the same keys with Alt to step backwards. Click next to \
             a line number to set a breakpoint, which can have a condition. Watches are GLSL expressions and may call \
             your own functions.",
            "Add a comment like this to print the value of an expression each time the line is reached; Shadertoy \
             ignores it:",
            "\t//@print distance * 0.5",
            "Add a comment like this to plot a value of a pass over time in the Measurements panel:",
            "\t//@probe sum(buffer_a.x)",
            "Step one frame back draws the previous frame with all buffers as they were.",
            "Compare draws this project and another one (the last save, a git revision or any other project) with the \
             same inputs, and shows both pictures, their difference and their times.",
            "Check precision compares some pixels with double precision, and lists what GLSL leaves undefined below \
             the code.",
        ],
    },
    Section {
        title: "Costs and the lab",
        paragraphs: &[
            "The Costs panel shows the time and memory of each pass. The Lab panel compares methods with a reference \
             and plots speed against error.",
        ],
    },
];
