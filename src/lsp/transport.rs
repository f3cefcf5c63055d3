//! The message stream: `Content-Length` and JSON, in both directions, and the order in which messages are handled.

use super::server::Server;
use eddy_project::limits;
use lsp_server::{ErrorCode, Message, Notification, RequestId};
use serde::Serialize;
use serde_json::json;
use std::{
    collections::VecDeque,
    io::{self, BufRead, BufReader, Read, Write},
    sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError, channel},
    time::Duration,
};

/// The polling interval while a program is being read.
const POLL: Duration = Duration::from_millis(2);

/// A message from the editor.
enum Incoming {
    Message(Message),
    /// A message that is not valid JSON of the protocol, and why.
    Malformed(String),
}

/// Serves one editor until it ends the server or closes its stream. Returns the exit code: 0 if it ended according to
/// the protocol. Returns an error if the streams cannot be read or written.
pub fn serve(input: impl Read + Send + 'static, output: impl Write) -> io::Result<u8> {
    let (sender, incoming) = channel();
    // The thread ends with the stream; a read cannot be interrupted, so the thread is never joined.
    std::thread::Builder::new().name("messages".into()).spawn(move || {
        let mut input = BufReader::new(input);
        while let Some(message) = read(&mut input).unwrap_or_else(|why| {
            log::error!("the editor's messages cannot be read: {why}");
            None
        }) {
            if sender.send(message).is_err() {
                break;
            }
        }
    })?;
    run(&incoming, output)
}

fn run(incoming: &Receiver<Incoming>, mut output: impl Write) -> io::Result<u8> {
    let mut server = Server::threaded();
    let mut waiting: VecDeque<Incoming> = VecDeque::new();
    let mut out = Vec::new();
    let mut is_open = true;
    loop {
        while is_open {
            match incoming.try_recv() {
                Ok(message) => waiting.push_back(message),
                Err(TryRecvError::Empty) => break,
                Err(TryRecvError::Disconnected) => is_open = false,
            }
        }
        take_cancelled(&mut waiting, &mut out);
        match waiting.pop_front() {
            Some(Incoming::Message(message)) => {
                if let Some(code) = server.handle(message, &mut out) {
                    write_all(&mut output, &mut out)?;
                    return Ok(code);
                }
            }
            Some(Incoming::Malformed(why)) => {
                // A message that cannot be parsed has no id.
                let error = json!({ "code": ErrorCode::ParseError as i32, "message": why });
                write_value(&mut output, &json!({ "id": null, "error": error }))?;
                output.flush()?;
            }
            None if server.idle(&mut out) => {}
            // A message is handled at once; without one, poll for the result of the reading.
            None if server.is_reading() => match incoming.recv_timeout(POLL) {
                Ok(message) => waiting.push_back(message),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    is_open = false;
                    std::thread::sleep(POLL);
                }
            },
            // The editor closed the stream without ending the server.
            None if !is_open => return Ok(1),
            None => match incoming.recv() {
                Ok(message) => waiting.push_back(message),
                Err(_) => is_open = false,
            },
        }
        write_all(&mut output, &mut out)?;
    }
}

/// Answers queued requests that a later message cancels.
fn take_cancelled(waiting: &mut VecDeque<Incoming>, out: &mut Vec<Message>) {
    let id = |message: &Incoming| match message {
        Incoming::Message(Message::Notification(Notification { method, params })) if method == "$/cancelRequest" => {
            serde_json::from_value::<RequestId>(params.get("id")?.clone()).ok()
        }
        _ => None,
    };
    let cancelled: Vec<RequestId> = waiting.iter().filter_map(id).collect();
    if cancelled.is_empty() {
        return;
    }
    waiting.retain(|message| match message {
        Incoming::Message(Message::Request(request)) if cancelled.contains(&request.id) => {
            out.push(Server::cancelled(request.id.clone()));
            false
        }
        message => id(message).is_none(),
    });
}

/// Reads the next message; `None` at the end of the stream.
fn read(input: &mut impl BufRead) -> io::Result<Option<Incoming>> {
    let mut length = None;
    loop {
        let mut line = Vec::new();
        // A header is short: a stream of another protocol must not fill the memory.
        if input.by_ref().take(MAX_HEADER_BYTES).read_until(b'\n', &mut line)? == 0 {
            return Ok(None);
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim();
        match line.split_once(':') {
            None if line.is_empty() && length.is_some() => break,
            Some((name, value)) if name.eq_ignore_ascii_case("Content-Length") => length = value.trim().parse().ok(),
            // Ignore other headers, and lines that are not headers.
            _ => {}
        }
    }
    let length: u64 = length.unwrap_or_default();
    let limit = limits::LSP_MESSAGE;
    let mut text = Vec::new();
    if length > limit.bytes {
        io::copy(&mut input.by_ref().take(length), &mut io::sink())?;
        return Ok(Some(Incoming::Malformed(format!("the message is larger than {limit}"))));
    }
    if input.by_ref().take(length).read_to_end(&mut text)? as u64 != length {
        return Ok(None);
    }
    Ok(Some(match serde_json::from_slice(&text) {
        Ok(message) => Incoming::Message(message),
        Err(why) => Incoming::Malformed(format!("the message is not one of JSON-RPC: {why}")),
    }))
}

/// The limit of a header line in bytes.
const MAX_HEADER_BYTES: u64 = 4096;

fn write_all(output: &mut impl Write, out: &mut Vec<Message>) -> io::Result<()> {
    if out.is_empty() {
        return Ok(());
    }
    for message in out.drain(..) {
        write_value(output, &message)?;
    }
    output.flush()
}

/// A message with the member that the protocol requires in each.
#[derive(Serialize)]
struct Envelope<'m, T> {
    jsonrpc: &'static str,
    #[serde(flatten)]
    message: &'m T,
}

fn write_value(output: &mut impl Write, message: &impl Serialize) -> io::Result<()> {
    let text = serde_json::to_vec(&Envelope { jsonrpc: "2.0", message })?;
    write!(output, "Content-Length: {}\r\n\r\n", text.len())?;
    output.write_all(&text)
}
