// ZIP files, stored and not compressed, by PKWARE's APPNOTE 6.3. The files themselves stay on disk:
// each is read once for its checksum, and again when the archive is sent.

const LOCAL = 0x04034b50;
const CENTRAL = 0x02014b50;
const END = 0x06054b50;
const VERSION = 20;
const UTF8 = 0x0800;
const FIRST_DAY = 0x0021; // 1 January 1980: the same files give the same archive

const TABLE = Uint32Array.from({ length: 256 }, (_, byte) => {
  let rest = byte;
  for (let bit = 0; bit < 8; bit += 1) rest = rest & 1 ? (rest >>> 1) ^ 0xedb88320 : rest >>> 1;
  return rest;
});

async function checksum(file) {
  let crc = 0xffffffff;
  const reader = file.stream().getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return (crc ^ 0xffffffff) >>> 0;
    for (let i = 0; i < value.length; i += 1) crc = TABLE[(crc ^ value[i]) & 0xff] ^ (crc >>> 8);
  }
}

// Returns bytes of little-endian numbers, each given as [bytes, value].
function packed(fields) {
  const view = new DataView(new ArrayBuffer(fields.reduce((sum, [size]) => sum + size, 0)));
  let at = 0;
  for (const [size, value] of fields) {
    if (size === 2) view.setUint16(at, value, true);
    else view.setUint32(at, value, true);
    at += size;
  }
  return view.buffer;
}

// What both headers of an entry say: flags, method, time, date, checksum, sizes, lengths.
function common({ name, crc, size }) {
  return [[2, UTF8], [2, 0], [2, 0], [2, FIRST_DAY], [4, crc], [4, size], [4, size], [2, name.length], [2, 0]];
}

// Returns the archive of [{path, file}] as a Blob; `told` hears how many bytes are read so far.
export async function zipped(files, told) {
  const sorted = [...files].sort((a, b) => (a.path < b.path ? -1 : 1));
  const parts = [];
  const index = [];
  let offset = 0;
  let read = 0;
  for (const { path, file } of sorted) {
    const entry = { name: new TextEncoder().encode(path), crc: await checksum(file), size: file.size };
    const fields = common(entry);
    const header = packed([[4, LOCAL], [2, VERSION], ...fields]);
    const closing = [[2, 0], [2, 0], [2, 0], [4, 0], [4, offset]];
    parts.push(header, entry.name, file);
    index.push(packed([[4, CENTRAL], [2, VERSION], [2, VERSION], ...fields, ...closing]), entry.name);
    offset += header.byteLength + entry.name.length + file.size;
    told((read += file.size));
  }
  const length = index.reduce((sum, part) => sum + part.byteLength, 0);
  const count = sorted.length;
  const end = packed([[4, END], [2, 0], [2, 0], [2, count], [2, count], [4, length], [4, offset], [2, 0]]);
  return new Blob([...parts, ...index, end], { type: "application/zip" });
}
