// check.mjs <program>: talks to sample_server.cpp with the client code that viewers use, and decodes every message of every channel
// with a library that shares no code with ours.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import rosmsg from "@foxglove/rosmsg";
import serialization from "@foxglove/rosmsg2-serialization";
import protocol from "@foxglove/ws-protocol";
import { WebSocket } from "ws";

const { FoxgloveClient } = protocol;

const server = spawn(process.argv[2], [], { stdio: ["pipe", "pipe", "inherit"] });
const [line] = await once(server.stdout, "data");
const url = `ws://127.0.0.1:${String(line).trim()}`;

const limit = setTimeout(() => fail("not done within 280 s"), 280_000);
function fail(why) {
  console.error(why);
  server.kill();
  process.exit(1);
}

function parsed(name, schema) {
  return rosmsg.parse(schema, { ros2: true });
}

// A viewer that subscribes to all channels and keeps what it decodes, by topic.
class Viewer {
  topics = new Map();
  channels = new Map();
  services = new Map();
  warnings = [];

  constructor(subprotocol) {
    this.socket = new WebSocket(url, [subprotocol]);
    this.client = new FoxgloveClient({ ws: this.socket });
    this.client.on("error", (error) => fail(`the client says ${error.message}`));
    this.client.on("status", (status) => this.warnings.push(status.message));
    this.client.on("advertise", (channels) => channels.forEach((channel) => this.add(channel)));
    this.client.on("advertiseServices", (services) => services.forEach((each) => this.services.set(each.name, each)));
    this.client.on("message", ({ subscriptionId, timestamp, data }) => {
      const { channel, reader } = this.channels.get(subscriptionId);
      this.topics.get(channel.topic).push({ timestamp, message: reader.readMessage(data) });
    });
  }

  add(channel) {
    assert.equal(channel.encoding, "cdr");
    assert.equal(channel.schemaEncoding, "ros2msg");
    const reader = new serialization.MessageReader(parsed(channel.schemaName, channel.schema));
    this.topics.set(channel.topic, []);
    this.channels.set(this.client.subscribe(channel.id), { channel, reader });
  }

  of(topic) {
    return this.topics.get(topic) ?? [];
  }

  async has(condition, what) {
    const end = Date.now() + 250_000;
    while (!condition(this)) {
      if (Date.now() > end) fail(`no ${what} within 250 s`);
      await new Promise((resolve) => setTimeout(resolve, 5));
    }
  }

  next(event) {
    return new Promise((resolve) => this.client.on(event, resolve));
  }
}

// That of the message is the first text of the flood.
const number = (timestamp) => Number(timestamp / 1_000_000n);

function checkValues(viewer) {
  for (const { timestamp, message } of viewer.of("/odom")) {
    assert.equal(message.pose.pose.position.x, number(timestamp) / 1024);
    assert.equal(message.twist.twist.angular.z, -number(timestamp));
    assert.equal(message.header.frame_id, "odom");
    assert.equal(message.child_frame_id, "base_footprint");
    assert.equal(BigInt(message.header.stamp.sec) * 1_000_000_000n + BigInt(message.header.stamp.nanosec), timestamp);
  }
  for (const { timestamp, message } of viewer.of("/joint_states")) {
    assert.deepEqual(message.name, ["left", "right"]);
    assert.deepEqual([...message.position], [number(timestamp), -number(timestamp)]);
  }
  for (const { timestamp, message } of viewer.of("/battery_state"))
    assert.equal(message.voltage, number(timestamp) % 1000);
  for (const { timestamp, message } of viewer.of("/diagnostics"))
    assert.deepEqual(message.status[0].values[0], { key: "age", value: String(number(timestamp)) });
  for (const { timestamp, message } of viewer.of("/flood")) {
    assert.equal(message.data.length, String(number(timestamp)).length + 4_000);
    assert.ok(message.data.startsWith(`${number(timestamp)}.`));
  }
  assert.equal(viewer.of("/robot_description")[0].message.data, "<robot name='none'/>");
}

// How many of the messages between the first and the last did not come.
function missing(viewer, topic) {
  const numbers = viewer.of(topic).map(({ timestamp }) => number(timestamp));
  for (let i = 1; i < numbers.length; ++i) assert.ok(numbers[i] > numbers[i - 1], "messages come in their order");
  return numbers.at(-1) - numbers[0] + 1 - numbers.length;
}

const fast = new Viewer(FoxgloveClient.SUPPORTED_SUBPROTOCOL);
const information = await fast.next("serverInfo");
assert.equal(information.name, "sample");
assert.deepEqual(information.supportedEncodings, ["cdr"]);
const slow = new Viewer("foxglove.sdk.v1");
for (const viewer of [fast, slow])
  await viewer.has(({ topics }) => topics.size === 7 && viewer.of("/diagnostics").length > 0, "messages of all topics");

// Parameters.
let values = fast.next("parameterValues");
fast.client.getParameters([], "all");
assert.deepEqual(await values, { op: "parameterValues", id: "all", parameters: [{ name: "c_R", value: 1, type: "float64" }] });
values = slow.next("parameterValues");
slow.client.subscribeParameterUpdates(["c_R"]);
await values;
values = slow.next("parameterValues");
fast.client.setParameters([{ name: "c_R", value: 1.0025 }], "set");
assert.equal((await values).parameters[0].value, 1.0025);
fast.client.setParameters([{ name: "c_R", value: 7.5 }], "bad");
await fast.has(({ warnings }) => warnings.includes("c_R cannot be this"), "refusal");

// A service, its request written and its response read from the definitions that the server gave.
const service = fast.services.get("/emergency_stop");
const request = new serialization.MessageWriter(parsed(service.request.schemaName, service.request.schema));
const answer = fast.next("serviceCallResponse");
const data = request.writeMessage({ structure_needs_at_least_one_member: 0 });
fast.client.sendServiceCallRequest({ serviceId: service.id, callId: 3, encoding: "cdr", data });
const response = await answer;
assert.equal(response.callId, 3);
const reply = new serialization.MessageReader(parsed(service.response.schemaName, service.response.schema));
assert.deepEqual(reply.readMessage(response.data), { success: true, message: "stopped" });

// A message of the client, which the robot repeats.
const echo = [...fast.channels.values()].find(({ channel }) => channel.topic === "/echo").channel;
const writer = new serialization.MessageWriter(parsed(echo.schemaName, echo.schema));
const channel = fast.client.advertise({ topic: "/cmd_vel", encoding: "cdr", schemaName: "geometry_msgs/msg/Twist" });
const twist = { linear: { x: 0.5, y: 0, z: 0 }, angular: { x: 0, y: 0, z: -1.25 } };
fast.client.sendMessage(channel, writer.writeMessage(twist));
await fast.has(() => fast.of("/echo").length > 0, "echo");
assert.deepEqual(fast.of("/echo")[0].message, twist);

// The flood goes as far ahead of this viewer as it has said that it has heard, so that it loses nothing on a busy machine either.
const heard = fast.client.advertise({ topic: "/heard", encoding: "cdr", schemaName: "std_msgs/msg/String" });
const flood = [...fast.channels.values()].find(({ channel }) => channel.topic === "/flood").channel;
const text = new serialization.MessageWriter(parsed(flood.schemaName, flood.schema));
fast.client.on("message", ({ subscriptionId, timestamp }) => {
  if (fast.channels.get(subscriptionId).channel === flood && number(timestamp) % 50 === 0)
    fast.client.sendMessage(heard, text.writeMessage({ data: String(number(timestamp)) }));
});

// The graph.
const graph = fast.next("connectionGraphUpdate");
fast.client.subscribeConnectionGraph();
assert.equal((await graph).publishedTopics.length, 9, "seven of the robot, /cmd_vel and /heard");

// One viewer that does not read for a while: 28 MB of the flood are more than what waits for it anywhere.
slow.socket.pause();
const before = fast.of("/flood").length;
await fast.has(() => fast.of("/flood").length > before + 7000, "7000 messages of the flood");
slow.socket.resume();
await slow.has(({ warnings }) => warnings.some((each) => each.includes("were dropped")), "word of dropped messages");
const newest = number(fast.of("/flood").at(-1).timestamp);
for (const viewer of [fast, slow])
  await viewer.has(() => number(viewer.of("/flood").at(-1)?.timestamp ?? 0n) > newest, "newest messages");

const [lost, kept] = [missing(slow, "/flood"), missing(fast, "/flood")];
console.log(`slow viewer: ${lost} of ${lost + slow.of("/flood").length} messages lost; fast viewer: ${kept} of ${fast.of("/flood").length}`);
assert.ok(lost > 100);
assert.equal(kept, 0);
assert.equal(missing(fast, "/odom"), 0);
for (const viewer of [fast, slow]) checkValues(viewer);
assert.deepEqual(fast.warnings, ["c_R cannot be this"]);

clearTimeout(limit);
for (const viewer of [fast, slow]) viewer.client.close();
server.stdin.end();
const [code] = await once(server, "exit");
assert.equal(code, 0);
