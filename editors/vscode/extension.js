// SPDX-License-Identifier: MIT
// Starts `twinpuck debug --dap`; everything else is the protocol's.
const fs = require("fs");
const vscode = require("vscode");

exports.activate = (context) => {
  const factory = {
    createDebugAdapterDescriptor: (session) => {
      const folder = session.workspaceFolder ? session.workspaceFolder.uri.fsPath : ".";
      // the clone's own, or that of the path where the workspace is not the clone
      const built = `${folder}/build/twinpuck`;
      const program = session.configuration.twinpuck || (fs.existsSync(built) ? built : "twinpuck");
      return new vscode.DebugAdapterExecutable(program, ["debug", "--dap"], { cwd: folder });
    },
  };
  context.subscriptions.push(vscode.debug.registerDebugAdapterDescriptorFactory("twinpuck", factory));
};
