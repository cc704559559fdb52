// write_uf2 PROGRAM.bin STAGE.bin IMAGE.uf2: makes of the bytes of an RP2040's flash, from its start on, what the chip's boot
// loader takes. Runs on the computer that builds the image.
//
// The boot ROM runs the second stage, the first 252 bytes, only if the next four are their check sum: that is computed here
// and put in its place. STAGE.bin becomes these 256 bytes, for the .elf file.
//
// Source  RP2040 data sheet, 2.8.1.3.1 (check sum); github.com/microsoft/uf2 (format)
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kStageBytes = 252, kPayload = 256, kBlock = 512;
constexpr std::uint32_t kFlash = 0x1000'0000, kFamily = 0xE48B'FF56, kFamilyPresent = 0x2000;

/// CRC-32 with the usual polynomial, but the highest bit first, and as it is in the end.
std::uint32_t check_sum(const std::uint8_t* bytes, std::size_t size) {
  std::uint32_t sum = ~0U;
  for (std::size_t i = 0; i < size; ++i) {
    sum ^= std::uint32_t{bytes[i]} << 24;
    for (int bit = 0; bit < 8; ++bit) sum = (sum << 1) ^ ((sum >> 31) != 0 ? 0x04C1'1DB7 : 0);
  }
  return sum;
}

void put(Bytes& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

Bytes block(const Bytes& program, std::uint32_t number, std::uint32_t count) {
  Bytes bytes;
  for (const std::uint32_t word :
       {0x0A32'4655U, 0x9E5D'5157U, kFamilyPresent, kFlash + number * static_cast<std::uint32_t>(kPayload),
        static_cast<std::uint32_t>(kPayload), number, count, kFamily})
    put(bytes, word);
  const auto from = program.begin() + static_cast<std::ptrdiff_t>(number * kPayload);
  bytes.insert(bytes.end(), from, from + kPayload);
  bytes.resize(kBlock - 4);
  put(bytes, 0x0AB1'6F30);
  return bytes;
}

Bytes read(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + name);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write(const std::string& name, const Bytes& bytes) {
  std::ofstream file(name, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) throw std::runtime_error("cannot write " + name);
}

void make(const std::string& program_file, const std::string& stage_file, const std::string& image_file) {
  Bytes program = read(program_file);
  if (program.size() <= kPayload)
    throw std::runtime_error(program_file + " has nothing behind the second stage");
  Bytes sum;
  put(sum, check_sum(program.data(), kStageBytes));
  std::copy(sum.begin(), sum.end(), program.begin() + kStageBytes);
  write(stage_file, Bytes(program.begin(), program.begin() + kPayload));
  program.resize((program.size() + kPayload - 1) / kPayload * kPayload, 0xFF);
  const auto count = static_cast<std::uint32_t>(program.size() / kPayload);
  Bytes image;
  for (std::uint32_t number = 0; number < count; ++number) {
    const Bytes bytes = block(program, number, count);
    image.insert(image.end(), bytes.begin(), bytes.end());
  }
  write(image_file, image);
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 4) throw std::runtime_error("usage: write_uf2 PROGRAM.bin STAGE.bin IMAGE.uf2");
  make(arguments[1], arguments[2], arguments[3]);
} catch (const std::exception& error) {
  std::fprintf(stderr, "write_uf2: %s\n", error.what());
  return 1;
}
