// What anisomesh-view put into the page: a JSON header, and base64 sections of little-endian numbers.

const types = { f32: Float32Array, u32: Uint32Array, i16: Int16Array, u16: Uint16Array, u8: Uint8Array };

function bytesOf(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** Takes the text out of the document, so that it is not kept twice. */
function take(id) {
  const element = document.getElementById(id);
  const text = element.textContent;
  element.remove();
  return text;
}

/** The header, with each model's arrays as typed arrays. */
export function readDocument() {
  const header = JSON.parse(take('header'));
  for (const model of header.models)
    for (const [name, { id, type }] of Object.entries(model.arrays))
      model.arrays[name] = new types[type](bytesOf(take(id)).buffer);
  return header;
}
