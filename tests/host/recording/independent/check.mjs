// check.mjs <folder>: reads sample.mcap with readers that share no code with host/recording and compares every
// value with odometry.csv and truth.csv beside it.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { loadDecompressHandlers } from "@mcap/support";
import rosmsg from "@foxglove/rosmsg";
import serialization from "@foxglove/rosmsg2-serialization";

const folder = process.argv[2];
const file = readFileSync(join(folder, "sample.mcap"));
const decompressHandlers = await loadDecompressHandlers();

function table(name) {
  const [head, ...rows] = readFileSync(join(folder, name), "utf8").trimEnd().split("\n");
  const names = head.split(",");
  return rows.map((row) => Object.fromEntries(row.split(",").map((cell, i) => [names[i], cell])));
}

const readers = new Map();
function decode(schema, data) {
  assert.equal(schema.encoding, "ros2msg");
  if (!readers.has(schema.name)) {
    const definitions = rosmsg.parse(new TextDecoder().decode(schema.data), { ros2: true });
    readers.set(schema.name, new serialization.MessageReader(definitions));
  }
  return readers.get(schema.name).readMessage(data);
}

function checkProfile(header) {
  assert.equal(header.profile, "ros2");
  assert.equal(header.library, "astrolabe");
}

// Front to back, every checksum validated, as a viewer does with a stream.
function readStreamed() {
  const reader = new McapStreamReader({ validateCrcs: true, decompressHandlers });
  reader.append(file);
  const schemas = new Map();
  const channels = new Map();
  const topics = {};
  const kinds = {};
  for (let record; (record = reader.nextRecord()); ) {
    kinds[record.type] = (kinds[record.type] ?? 0) + 1;
    if (record.type === "Header") checkProfile(record);
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type !== "Message") continue;
    const channel = channels.get(record.channelId);
    assert.equal(channel.messageEncoding, "cdr");
    assert.ok(channel.metadata.has("offered_qos_profiles"));
    (topics[channel.topic] ??= []).push({ record, message: decode(schemas.get(channel.schemaId), record.data) });
  }
  assert.ok(reader.done(), "the stream ends in its footer");
  return { topics, kinds };
}

// Through the summary and the message indexes, as a viewer does that seeks.
async function readIndexed() {
  const readable = {
    size: async () => BigInt(file.length),
    read: async (offset, length) => new Uint8Array(file.subarray(Number(offset), Number(offset + length))),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  checkProfile(reader.header);
  const times = {};
  for await (const message of reader.readMessages()) {
    (times[reader.channelsById.get(message.channelId).topic] ??= []).push(message.logTime);
  }
  const seek = [];
  for await (const message of reader.readMessages({ startTime: 5_000_000_000n, endTime: 5_100_000_000n })) {
    seek.push(message.logTime);
  }
  const metadata = [];
  for await (const record of reader.readMetadata()) metadata.push(record);
  return { reader, times, seek, metadata };
}

const micros = (stamp) => stamp.sec * 1_000_000 + stamp.nanosec / 1000;
const seconds = (stamp) => (micros(stamp) / 1e6).toFixed(6);
const heading = ({ z, w }) => 2 * Math.atan2(z, w);
const apart = (a, b) => Math.abs(Math.atan2(Math.sin(a - b), Math.cos(a - b)));

const odometry = table("odometry.csv");
const truth = table("truth.csv");
const { topics, kinds } = readStreamed();
assert.deepEqual(Object.keys(topics).sort(), ["/odom", "/truth", "/wheel_counts"]);
assert.equal(topics["/odom"].length, odometry.length);
assert.equal(topics["/wheel_counts"].length, odometry.length);
assert.equal(topics["/truth"].length, truth.length);
assert.ok(kinds.Statistics === 1 && kinds.ChunkIndex > 2 && kinds.SummaryOffset > 0, JSON.stringify(kinds));

odometry.forEach((row, i) => {
  const { record, message } = topics["/odom"][i];
  const counts = topics["/wheel_counts"][i].message;
  assert.equal(seconds(message.header.stamp), row.__time);
  assert.equal(record.logTime, BigInt(micros(message.header.stamp)) * 1000n);
  assert.equal(message.header.frame_id, "odom");
  assert.equal(message.child_frame_id, "base_link");
  assert.equal(message.pose.pose.position.x, Number(row["/odom/x_m"]));
  assert.equal(message.pose.pose.position.y, Number(row["/odom/y_m"]));
  assert.ok(apart(heading(message.pose.pose.orientation), Number(row["/odom/theta_rad"])) < 1e-14);
  assert.equal(message.pose.covariance.length, 36);
  assert.equal(message.twist.twist.linear.x, Number(row["/odom/v_mps"]));
  assert.equal(message.twist.twist.angular.z, Number(row["/odom/omega_radps"]));
  assert.equal(seconds(counts.stamp), row.__time);
  assert.equal(counts.left, Number(row["/odom/left_counts"]));
  assert.equal(counts.right, Number(row["/odom/right_counts"]));
});

truth.forEach((row, i) => {
  const { message } = topics["/truth"][i];
  assert.equal(seconds(message.header.stamp), row.__time);
  assert.equal(message.header.frame_id, "truth");
  const { position, orientation } = message.pose;
  if (row["/truth/valid"] === "0") {
    assert.ok([position.x, position.y, orientation.z, orientation.w].every(Number.isNaN));
    return;
  }
  assert.equal(position.x, Number(row["/truth/x_m"]));
  assert.equal(position.y, Number(row["/truth/y_m"]));
  assert.ok(apart(heading(orientation), Number(row["/truth/theta_rad"])) < 1e-14);
});

const { reader, times, seek, metadata } = await readIndexed();
assert.equal(reader.statistics.messageCount, BigInt(2 * odometry.length + truth.length));
for (const [topic, list] of Object.entries(topics)) {
  assert.deepEqual(times[topic], list.map(({ record }) => record.logTime));
}
const everything = Object.values(topics).flat().map(({ record }) => record.logTime);
assert.equal(seek.length, everything.filter((t) => t >= 5_000_000_000n && t <= 5_100_000_000n).length);
assert.ok(metadata.length === 2 && metadata.every(({ name }) => name === "astrolabe.run"));
const info = metadata.at(-1).metadata;
assert.equal(info.get("kind"), "circle");
assert.equal(info.get("direction"), "ccw");
assert.equal(Number(info.get("parameter.c_R")), 1.00207);
console.log(`${everything.length} messages in ${kinds.ChunkIndex} chunks agree with the CSV files`);
