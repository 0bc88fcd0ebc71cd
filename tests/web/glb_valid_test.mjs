// glb_valid_test.mjs WEB_FOLDER FILE: the Khronos validator must find nothing, not even a hint. One remark is expected:
// meshes carry texture coordinates for whoever puts a texture on, and no texture.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';

const [webFolder, file] = process.argv.slice(2);
const validator = createRequire(`${webFolder}/package.json`)('gltf-validator');
const report = await validator.validateBytes(new Uint8Array(await readFile(file)), { uri: file });
const { numErrors, numWarnings, numInfos, numHints } = report.issues;
const messages = report.issues.messages.filter((m) => !(m.code === 'UNUSED_OBJECT' && m.pointer.endsWith('/TEXCOORD_0')));
console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints;`,
  `${report.info.animationCount} animations, ${report.info.totalVertexCount} vertices`);
if (messages.length > 0) {
  console.log(messages.slice(0, 20));
  process.exit(1);
}
if (report.info.animationCount !== 1 || !(report.info.totalVertexCount > 0)) {
  console.log('expected one animation and some vertices');
  process.exit(1);
}
