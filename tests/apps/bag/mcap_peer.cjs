// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

// Copies an MCAP file by an implementation that is not ours: takes each message apart by the
// definition in the file, and puts it together again.
//   node mcap_peer.cjs IN OUT zstd|none|chunkless|bare
// Prints how many messages there were, and the first of each topic.
const fs = require('fs');
const {McapIndexedReader, McapWriter} = require('@mcap/core');
const {loadDecompressHandlers} = require('@mcap/support');
const {parse} = require('@foxglove/rosmsg');
const {MessageReader, MessageWriter} = require('@foxglove/rosmsg2-serialization');
const zstd = require('@foxglove/wasm-zstd');

class FileIn {
  constructor(path) { this.file = fs.openSync(path); }
  async size() { return BigInt(fs.fstatSync(this.file).size); }
  async read(at, size) {
    const bytes = new Uint8Array(Number(size));
    const count = fs.readSync(this.file, bytes, 0, Number(size), Number(at));
    return bytes.subarray(0, count);
  }
}

class FileOut {
  constructor(path) { this.file = fs.openSync(path, 'w'); this.at = 0n; }
  async write(bytes) { fs.writeSync(this.file, bytes); this.at += BigInt(bytes.byteLength); }
  position() { return this.at; }
}

function optionsOf(mode) {
  if (mode === 'chunkless') return {useChunks: false};
  const bare = {useStatistics: false, useSummaryOffsets: false, repeatSchemas: false,
                repeatChannels: false, useMessageIndex: false, useChunkIndex: false};
  if (mode === 'bare') return bare;
  const compressChunk =
      mode === 'zstd' ? data => ({compression: 'zstd', compressedData: zstd.compress(data)}) : undefined;
  return {chunkSize: 4096, compressChunk};
}

async function copy(from, to, mode) {
  await zstd.isLoaded;
  const reader = await McapIndexedReader.Initialize(
      {readable: new FileIn(from), decompressHandlers: await loadDecompressHandlers()});
  const writer = new McapWriter({writable: new FileOut(to), ...optionsOf(mode)});
  await writer.start({profile: reader.header.profile, library: 'peer'});
  const topics = new Map();
  let count = 0;
  for await (const message of reader.readMessages()) {
    if (!topics.has(message.channelId)) {
      const channel = reader.channelsById.get(message.channelId);
      const schema = reader.schemasById.get(channel.schemaId);
      const definitions = parse(new TextDecoder().decode(schema.data), {ros2: true});
      const schemaId = await writer.registerSchema(schema);
      const channelId = await writer.registerChannel({...channel, schemaId});
      const codec = {channelId, reader: new MessageReader(definitions), writer: new MessageWriter(definitions)};
      topics.set(message.channelId, codec);
      const first = codec.reader.readMessage(message.data);
      console.log(channel.topic, schema.name, JSON.stringify(first, (key, value) =>
        typeof value === 'bigint' ? Number(value) : value));
    }
    const {channelId, reader: taker, writer: giver} = topics.get(message.channelId);
    const data = giver.writeMessage(taker.readMessage(message.data));
    await writer.addMessage({...message, channelId, data});
    ++count;
  }
  await writer.end();
  const told = reader.statistics.messageCount;
  console.log(`${count} messages, ${told} by the statistics`);
}

copy(...process.argv.slice(2)).catch(error => {
  console.error(error);
  process.exit(1);
});
