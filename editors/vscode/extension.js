// SPDX-License-Identifier: MIT
// Starts `twinpuck debug --dap`; everything else is the protocol's.
const vscode = require("vscode");

exports.activate = (context) => {
  const factory = {
    createDebugAdapterDescriptor: (session) => {
      const folder = session.workspaceFolder ? session.workspaceFolder.uri.fsPath : ".";
      const program = session.configuration.twinpuck || `${folder}/build/twinpuck`;
      return new vscode.DebugAdapterExecutable(program, ["debug", "--dap"], { cwd: folder });
    },
  };
  context.subscriptions.push(vscode.debug.registerDebugAdapterDescriptorFactory("twinpuck", factory));
};
