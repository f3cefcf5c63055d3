// Starts `eddy lsp` for GLSL files, and the window beside the editor.
const { spawn } = require("child_process");
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

function program() {
    return vscode.workspace.getConfiguration("eddy").get("path", "eddy");
}

async function start() {
    const server = { command: program(), args: ["lsp"] };
    const options = {
        documentSelector: [
            { language: "glsl" },
            { pattern: "**/eddy.toml" },
        ],
    };
    client = new LanguageClient("eddy", "Eddy", server, options);
    try {
        await client.start();
    } catch (error) {
        const settings = "Open settings";
        const chosen = await vscode.window.showErrorMessage(`${program()} lsp cannot be started: ${error.message}`, settings);
        if (chosen === settings) {
            vscode.commands.executeCommand("workbench.action.openSettings", "eddy.path");
        }
    }
}

// The window opens the project that has the file.
async function open() {
    const document = vscode.window.activeTextEditor?.document;
    if (!document || document.uri.scheme !== "file") {
        vscode.window.showInformationMessage("Open a shader first");
        return;
    }
    await document.save();
    const child = spawn(program(), ["--follow", document.fileName], { detached: true, stdio: "ignore" });
    child.on("error", (error) => vscode.window.showErrorMessage(`${program()} cannot be started: ${error.message}`));
    child.unref();
}

exports.activate = async (context) => {
    context.subscriptions.push(
        vscode.commands.registerCommand("eddy.open", open),
        vscode.commands.registerCommand("eddy.restart", () => client?.stop().then(start)),
    );
    await start();
};

exports.deactivate = () => client?.stop();
