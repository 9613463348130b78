// Bundles the page into page/dist, or with the argument `tests` its tests into page/dist-tests.
import { build } from "esbuild";
import { cp, mkdir, readdir, rm } from "node:fs/promises";
import { fileURLToPath } from "node:url";

const here = fileURLToPath(new URL(".", import.meta.url));
const common = { absWorkingDir: here, bundle: true, format: "esm", logLevel: "warning", target: "es2022" };

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
  await mkdir(`${here}dist`, { recursive: true });
  await build({
    ...common,
    entryPoints: ["src/main.ts", "src/worker.ts", "src/offline.ts", "src/style.css"],
    outdir: "dist",
    minify: true,
    splitting: true,
    chunkNames: "part-[hash]",
  });
  await cp(`${here}index.html`, `${here}dist/index.html`);
}
