# SPDX-License-Identifier: MIT
"""The wire of the Debug Adapter Protocol, for scripts that play an editor."""
import json
import subprocess


class Server:
    """`twinpuck debug --dap`, and what it has said."""

    def __init__(self, program):
        self.process = subprocess.Popen([program, "debug", "--dap"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.sequence = 0
        self.events = []

    def receive(self):
        length = 0
        while (line := self.process.stdout.readline().strip()):
            length = int(line.split(b":")[1])
        assert length > 0, "the server has ended"
        return json.loads(self.process.stdout.read(length))

    def ask(self, command, **arguments):
        """The response; events that come before it are kept."""
        self.sequence += 1
        message = {"seq": self.sequence, "type": "request", "command": command, "arguments": arguments}
        text = json.dumps(message).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(text), text))
        self.process.stdin.flush()
        while (message := self.receive())["type"] == "event":
            self.events.append(message)
        assert message["request_seq"] == self.sequence and message["command"] == command, message
        return message

    def good(self, command, **arguments):
        """The body of a response that must be one of success."""
        response = self.ask(command, **arguments)
        assert response["success"], response
        return response.get("body", {})

    def event(self, name):
        """The body of the next event of that name."""
        while True:
            for e in self.events:
                if e["event"] == name:
                    self.events.remove(e)
                    return e.get("body", {})
            self.events.append(self.receive())
