// Runs a program for WASI: node --single-threaded --no-warnings run.mjs PROGRAM ARGUMENTS…
// With more threads, Node 20.20 crashes now and then after the program has ended.
import { existsSync, readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { WASI } from 'node:wasi';

const [program, ...given] = process.argv.slice(2);
const args = given.map((argument) => (existsSync(argument) ? resolve(argument) : argument)); // WASI has no working directory
const wasi = new WASI({ version: 'preview1', args: [program, ...args], preopens: { '/': '/' } });
const { instance } = await WebAssembly.instantiate(readFileSync(program), { wasi_snapshot_preview1: wasi.wasiImport });
process.exitCode = wasi.start(instance);
