#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""example_client.py ADDRESS: steps a live view for two seconds and prints where its first robot goes."""
import base64, json, os, socket, struct, sys, urllib.parse

url = urllib.parse.urlparse(sys.argv[1])
line = socket.create_connection((url.hostname, url.port))
key = base64.b64encode(os.urandom(16)).decode()
line.sendall(("GET %slive HTTP/1.1\r\nHost: %s\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
              "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: %s\r\n\r\n" % (url.path, url.netloc, key)).encode())
stream = line.makefile("rb")
assert b"101" in stream.readline()
while stream.readline().strip():
    pass


def send(message):
    text = json.dumps(message).encode()  # masked with zeros, as clients must mask
    head = struct.pack("!BBH", 0x81, 0x80 | 126, len(text)) + bytes(4)
    line.sendall(head + text)


def receive():
    kind, size = stream.read(2)
    size = struct.unpack("!H", stream.read(2))[0] if size == 126 else \
        struct.unpack("!Q", stream.read(8))[0] if size == 127 else size
    body = stream.read(size)
    return json.loads(body) if kind & 15 == 1 else body


assert receive()["version"] == 2  # hello
send({"id": 0, "do": "steer"})
last_s = 0
for step in range(1, 21):
    send({"id": step, "do": "step", "unit": "control", "count": 3})
    answered, frame = False, None
    while not answered or frame is None:
        message = receive()
        if isinstance(message, bytes):
            time_s = struct.unpack_from("<d", message, 8)[0]
            frame = message if time_s > last_s else None  # or else of the step before
        else:
            answered = answered or message.get("answer") == step
    last_s = time_s
    values = struct.unpack_from("<I", frame, 36)[0]
    x, y, z, heading = struct.unpack_from("<4f", frame, 48 + 8 * values)
    print("%.3f s: x %.3f m, y %.3f m" % (time_s, x, y))
