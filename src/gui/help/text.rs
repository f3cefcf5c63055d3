//! Owns what the help says besides the keys.

/// A part of the help: a title, and paragraphs. What stands behind a tab is code.
pub(super) struct Section {
    pub title: &'static str,
    pub paragraphs: &'static [&'static str],
}

pub(super) const SECTIONS: &[Section] = &[
    Section {
        title: "First steps",
        paragraphs: &[
            "Take a preset from the gallery, or begin a new shader. What is typed is compiled by itself and shown; \
             where it has an error, the last good picture runs on and the list below the code says \
             what is wrong and where.",
            "Editing a preset edits a copy. Save writes the project into a folder of plain texts. What is typed is in \
             a recovery file within a second, and is offered at the next start if Eddy ended before it was saved.",
            "Another editor can be used beside this one: a file that it saves is taken in at once.",
        ],
    },
    Section {
        title: "Keyboard",
        paragraphs: &[
            "A blue frame shows what has the keyboard. Click the picture to send keys to the shader, the code to type.",
            "F6 goes to the next part of the window, Shift+F6 to the one before. Tab goes from one control to the next \
             within it, Space or Enter presses it, the arrow keys turn a slider. Escape gives the keyboard back to the \
             code or to the picture, whichever had it last.",
            "Shift+F10, or the menu key, opens the menu of a tab. The command palette has \"This panel\" for what a hand \
             drags: it makes the panel that has the keyboard wider, narrower, higher or lower, and moves or closes it.",
            "In a dialog Enter presses the coloured button, Escape cancels. The command palette finds every action by \
             a few letters of its name.",
        ],
    },
    Section {
        title: "The picture",
        paragraphs: &[
            "The mouse over the picture is iMouse: xy is where it is while it is down, zw where it went down. Keys are \
             read from the keyboard's texture, which a channel can be set to.",
            "A new size starts buffers anew. Sizes, scales and the pass that is shown are chosen in the bar below. A \
             picture is saved in the project's folder, or where pictures are kept for a project without one.",
            "A frame that takes longer than the limit pauses the picture and asks what to do. The text is never \
             touched.",
        ],
    },
    Section {
        title: "Passes and channels",
        paragraphs: &[
            "Passes are drawn in the order of their tabs, Image last. Common stands before the text of each. + adds \
             one; a right click on a tab shows or removes it.",
            "A channel is what iChannel0 to iChannel3 read: another pass, the keyboard, a picture. A pass that reads \
             itself, or one that is drawn after it, sees the frame before.",
        ],
    },
    Section {
        title: "Uniforms",
        paragraphs: &[
            "A line in the code declares a uniform that is turned by hand, without compiling:",
            "\t#iUniform float speed = 1.0 in { 0.0, 5.0 }",
            "\t#iUniform color3 tint = color3(1.0, 0.5, 0.0)",
            "Types are float, int, bool, vec2, vec3, vec4 and color3. A step of a slider is written as step 0.1 behind \
             the range.",
            "Drag a slider, or click its number to type one. A double click on the name or the rail goes back to the \
             default. Values are saved with the project.",
        ],
    },
    Section {
        title: "Seeing inside",
        paragraphs: &[
            "Probe expression draws the value at the caret instead of the picture: the bar over it says its range, its \
             histogram and the number under the mouse. Stripes are pixels that never came by. Escape ends it. With \
             Ctrl and Alt held, what the pointer is over is probed. Buffers go on as before.",
            "Trace pixel, or a click on the picture with Ctrl and Shift held, pauses and follows one pixel through its \
             code. Each line can then be gone to and back again: forwards by the usual keys of a debugger, backwards \
             by the same keys with Alt. A click beside a line's number sets a breakpoint, which can have a condition. \
             Watches are expressions of the language, and may call your own functions.",
            "A comment prints what an expression is where it stands, each time, and means nothing to the site:",
            "\t//@print distance * 0.5",
            "Another comment has a number of a pass measured, which the panel Measurements plots over time while it is \
             open:",
            "\t//@probe sum(buffer_a.x)",
            "One frame back draws the frame before again, with every buffer as it was. Record input writes down what \
             each frame is given, so that the command line draws the same frames again.",
            "Compare draws this project and another one (its last save, a revision of its git repository, any other \
             project) from the same inputs, and shows both pictures, their difference and how their times compare.",
            "Check the picture holds some of its pixels against double precision, and lists what GLSL leaves undefined \
             below the code.",
        ],
    },
    Section {
        title: "The lab and costs",
        paragraphs: &[
            "The table of costs says what each pass takes in time and memory. The lab measures methods against a \
             reference and plots their speed against their error.",
        ],
    },
];
