#!/usr/bin/env bash
# The C libraries of the module as Debian's source packages, unpacked for libraries.cmake, and sqlite's one-file form made.
# Needs no root: apt reads a list of its own beside the system's.      fetch_sources.sh FOLDER
set -euo pipefail
mkdir -p "$1"
cd "$1"

# Package and version, so that everybody compiles the same.
packages=(bzip2=1.0.8-5 libyaml=0.2.5-1 libzstd=1.5.4+dfsg2-5 lz4=1.9.4-1 sqlite3=3.40.1-2+deb12u2 tinyxml2=9.0.0+dfsg-3.1
  zlib=1:1.2.13.dfsg-1)
[[ -e done && $(<done) == "${packages[*]}" ]] && exit

rm -rf -- *-src *.dsc *.tar.* *.asc apt done
mkdir -p apt/lists/partial apt/archives/partial
sed -n '/^Types:/,/^$/p' /etc/apt/sources.list.d/*.sources 2>/dev/null | sed 's/^Types:.*/Types: deb-src/' >apt/all.sources || true
sed -n 's/^deb /deb-src /p' /etc/apt/sources.list 2>/dev/null >apt/all.list || true
apt=(-qq -o Dir::Etc::SourceList="$PWD/apt/all.list" -o Dir::Etc::SourceParts="$PWD/apt" -o Dir::State::Lists="$PWD/apt/lists"
  -o Dir::Cache="$PWD/apt" -o APT::Sandbox::User="$(id -un)")
apt-get "${apt[@]}" update
if ! apt-get "${apt[@]}" source --download-only "${packages[@]}"; then
  echo "Debian has replaced one of these versions; its present ones are taken: ${packages[*]}" >&2
  apt-get "${apt[@]}" source --download-only "${packages[@]%%=*}"
fi
for description in *.dsc; do
  dpkg-source --no-check --extract "$description" "./${description%%_*}-src" >/dev/null
done
rm -rf -- *.dsc *.tar.* *.asc apt

(cd sqlite3-src && ./configure >/dev/null && make sqlite3.c >/dev/null)
printf '%s' "${packages[*]}" >done
