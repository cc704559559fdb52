#include "host/emulator/core/symbols.hpp"

#include <cxxabi.h>
#include <elf.h>
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>

#include "host/base/error.hpp"

namespace astro::emulator {
namespace {

std::string readable(const std::string& linker_name) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(
      abi::__cxa_demangle(linker_name.c_str(), nullptr, nullptr, &status), std::free);
  return status == 0 ? name.get() : linker_name;
}

/// A file in memory; throws if a structure that is read lies outside of it.
class File {
 public:
  explicit File(const std::filesystem::path& path) : path_(path) {
    std::ifstream file(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
    if (bytes_.size() < sizeof(Elf32_Ehdr) || bytes_.compare(0, SELFMAG, ELFMAG) != 0 ||
        bytes_[EI_CLASS] != ELFCLASS32 || bytes_[EI_DATA] != ELFDATA2LSB)
      throw Error(fmt::format("'{}' is no 32-bit little-endian ELF file", path.string()));
  }

  template <class T>
  T at(std::size_t offset) const {
    T value;
    check(offset, sizeof value);
    std::memcpy(&value, bytes_.data() + offset, sizeof value);
    return value;
  }

  std::string text_at(std::size_t offset) const {
    check(offset, 1);
    return bytes_.substr(offset, bytes_.find('\0', offset) - offset);
  }

 private:
  void check(std::size_t offset, std::size_t size) const {
    if (offset > bytes_.size() || size > bytes_.size() - offset)
      throw Error(fmt::format("'{}' ends before its symbols do: build the image again", path_.string()));
  }

  std::filesystem::path path_;
  std::string bytes_;
};

}  // namespace

Symbols::Symbols(const std::filesystem::path& elf) {
  const File file(elf);
  const auto header = file.at<Elf32_Ehdr>(0);
  const auto section = [&](std::size_t n) {
    return file.at<Elf32_Shdr>(header.e_shoff + n * sizeof(Elf32_Shdr));
  };
  for (std::size_t n = 0; n < header.e_shnum; ++n) {
    const Elf32_Shdr table = section(n);
    if (table.sh_type != SHT_SYMTAB) continue;
    const Elf32_Shdr names = section(table.sh_link);
    for (std::size_t at = 0; at + sizeof(Elf32_Sym) <= table.sh_size; at += sizeof(Elf32_Sym)) {
      const auto symbol = file.at<Elf32_Sym>(table.sh_offset + at);
      if (ELF32_ST_TYPE(symbol.st_info) > STT_FUNC || symbol.st_shndx == SHN_UNDEF ||
          symbol.st_shndx == SHN_ABS)
        continue;
      const bool function = ELF32_ST_TYPE(symbol.st_info) == STT_FUNC;
      add(file.text_at(names.sh_offset + symbol.st_name), symbol.st_value & ~(function ? 1U : 0U),
          symbol.st_size);
    }
  }
}

/// If an address has several names, one with a size is preferred. Names such as $t and $d only mark code and
/// data.
void Symbols::add(const std::string& linker_name, std::uint32_t address, std::uint32_t bytes) {
  if (linker_name.empty() || linker_name[0] == '$') return;
  const std::string name = readable(linker_name);
  const auto [entry, fresh] = by_address_.try_emplace(address, Symbol{name, bytes});
  if (!fresh && entry->second.bytes == 0) entry->second = {name, bytes};
}

std::string Symbols::name_at(std::uint32_t address) const {
  auto next = by_address_.upper_bound(address);
  if (next == by_address_.begin()) return "";
  const auto& [begin, symbol] = *--next;
  if (symbol.bytes != 0 && address - begin >= symbol.bytes) return "";
  return address == begin ? symbol.name : fmt::format("{}+0x{:X}", symbol.name, address - begin);
}

}  // namespace astro::emulator
