//! Values from outside: OSC, MIDI and gamepads.
