// Bundles the page into page/dist, or with the argument `tests` its tests into page/dist-tests. `scripts/page build` compiles the core before.
import { build } from "esbuild";
import { execFileSync } from "node:child_process";
import { cp, mkdir, readdir, readFile, rm, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";

const here = fileURLToPath(new URL(".", import.meta.url));
const common = { absWorkingDir: here, bundle: true, format: "esm", logLevel: "warning", target: "es2022" };

/** The machine files with the files that they name. */
async function machines() {
  const folder = `${here}../machines/`;
  const all = [];
  for (const name of (await readdir(folder)).filter((name) => name.endsWith(".toml")).sort()) {
    const text = await readFile(folder + name, "utf8");
    const files = {};
    for (const [, other] of text.matchAll(/"([^"/]+\.csv)"/g)) files[other] = await readFile(folder + other, "utf8");
    const title = /^title = "([^"]+)"/m.exec(text)?.[1] ?? name;
    all.push({ name, title, text, ...(Object.keys(files).length > 0 && { files }) });
  }
  return JSON.stringify(all);
}

/** The core, made smaller (-Oz is larger by 3 % once it is compressed); `JRED_CORE` names another one, which is taken as it is. */
async function core() {
  const to = `${here}dist/core.wasm`;
  if (process.env.JRED_CORE) return cp(process.env.JRED_CORE, to);
  const from = `${here}../target/wasm32-unknown-unknown/page/jred_page.wasm`;
  const allowed = ["bulk-memory", "mutable-globals", "nontrapping-float-to-int", "sign-ext"].map((feature) => `--enable-${feature}`);
  execFileSync(`${here}node_modules/.bin/wasm-opt`, ["-O1", "--strip-debug", ...allowed, from, "-o", to], { stdio: "inherit" });
}

if (process.argv[2] === "tests") {
  const tests = (await readdir(`${here}tests`)).filter((name) => name.endsWith(".test.ts"));
  await rm(`${here}dist-tests`, { recursive: true, force: true });
  await build({
    ...common,
    entryPoints: tests.map((name) => `tests/${name}`),
    outdir: "dist-tests",
    packages: "external",
    platform: "node",
    sourcemap: "inline",
  });
} else {
  await rm(`${here}dist`, { recursive: true, force: true });
  await mkdir(`${here}dist`);
  await build({
    ...common,
    entryPoints: ["src/main.ts", "src/worker.ts", "src/offline.ts", "src/style.css"],
    outdir: "dist",
    minify: true,
    splitting: true,
    chunkNames: "part-[hash]",
  });
  await cp(`${here}index.html`, `${here}dist/index.html`);
  await writeFile(`${here}dist/machines.json`, await machines());
  await core();
  // What the service worker keeps for times without a network.
  await writeFile(`${here}dist/files.json`, JSON.stringify((await readdir(`${here}dist`)).sort()));
}
