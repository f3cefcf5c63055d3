//! The machine's MIDI devices, by midir: ALSA's sequencer, CoreMIDI, or the multimedia library of Windows.

use super::host::{MidiError, MidiHost, MidiIn, Opened, Take};
use midir::{Ignore, MidiInput, MidiInputPort};

/// Eddy's name as shown to other programs.
const CLIENT: &str = "Eddy";

/// The MIDI devices of this machine.
#[derive(Clone, Copy, Debug, Default)]
pub struct Machine;

impl MidiHost for Machine {
    fn input(&self) -> Box<dyn MidiIn> {
        Box::new(Machine)
    }
}

impl MidiIn for Machine {
    fn names(&mut self) -> Result<Vec<String>, MidiError> {
        Ok(named(&client()?).into_iter().map(|(name, _)| name).collect())
    }

    fn open(&mut self, name: &str, mut take: Take) -> Result<Opened, MidiError> {
        let client = client()?;
        let port = named(&client).into_iter().find(|(known, _)| known == name);
        let (_, port) = port.ok_or_else(|| MidiError::Unknown(name.to_owned()))?;
        let connected = client.connect(&port, "in", move |_, bytes, ()| take(bytes), ());
        let refused = |error: midir::ConnectError<MidiInput>| MidiError::Refused {
            name: name.to_owned(),
            why: error.to_string(),
        };
        connected.map(|connection| Box::new(connection) as Opened).map_err(refused)
    }
}

fn client() -> Result<MidiInput, MidiError> {
    // ALSA prints to the terminal if there is no sequencer.
    #[cfg(any(target_os = "linux", target_os = "dragonfly", target_os = "freebsd", target_os = "netbsd"))]
    let _ = alsa::Output::local_error_handler();
    let mut client = MidiInput::new(CLIENT).map_err(|_| MidiError::NoMidi)?;
    client.ignore(Ignore::All);
    Ok(client)
}

/// Returns the devices under names that do not change when they are plugged in again, without duplicates.
fn named(client: &MidiInput) -> Vec<(String, MidiInputPort)> {
    let ports = client.ports();
    let names = ports.iter().map(|port| client.port_name(port).ok());
    let mut found: Vec<(String, MidiInputPort)> = Vec::new();
    for (name, port) in names.zip(&ports) {
        let Some(name) = name.filter(|name| !name.starts_with(CLIENT)) else { continue };
        let plain = without_numbers(&name);
        let is_new = |name: &String| found.iter().all(|(known, _)| known != name);
        let numbered = (2..).map(|n| format!("{plain} ({n})"));
        if let Some(free) = std::iter::once(plain.to_owned()).chain(numbered).find(is_new) {
            found.push((free, port.clone()));
        }
    }
    found
}

/// Strips the numbers of ALSA's client and port, which differ each time.
fn without_numbers(name: &str) -> &str {
    let is_numbers = |text: &str| {
        let number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        text.split_once(':').is_some_and(|(client, port)| number(client) && number(port))
    };
    name.rsplit_once(' ').filter(|(_, last)| is_numbers(last)).map_or(name, |(name, _)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changing_numbers_are_stripped_from_names() {
        assert_eq!(without_numbers("nanoKONTROL2:nanoKONTROL2 MIDI 1 20:0"), "nanoKONTROL2:nanoKONTROL2 MIDI 1");
        assert_eq!(without_numbers("Launch Control XL"), "Launch Control XL");
        assert_eq!(without_numbers("A 1:2b"), "A 1:2b");
    }

    /// No panic and no such device, on machines with and without MIDI.
    #[test]
    fn a_missing_device_is_an_error() {
        let mut machine = Machine;
        let _ = machine.names();
        assert!(machine.open("no such device", Box::new(|_| {})).is_err());
    }
}
