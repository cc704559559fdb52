import { defineConfig } from "vite";

// Any web server can host the result in any folder: all addresses are relative.
export default defineConfig({
  base: "./",
  esbuild: { jsx: "automatic", jsxImportSource: "preact" },
  build: { target: "es2022", outDir: process.env.ASTROLABE_PAGE_OUT ?? "dist", emptyOutDir: true },
  worker: { format: "es" },
});
