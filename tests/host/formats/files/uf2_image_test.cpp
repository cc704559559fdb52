#include "host/formats/files/uf2_image.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <random>

#include "host/base/bytes.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro {
namespace {

using support::ThrowsTelling;

constexpr std::size_t kUf2Block = 512;

/// A program of two pages with a valid second stage, written from the format's description, and the file that holds it.
class Uf2File : public testing::Test {
 protected:
  Uf2File() {
    // The check sum of 252 zeros: computed by the bit-reversed algorithm (zlib's) on reversed bits, which are zeros, too.
    std::uint32_t reversed = ~0U;
    for (int bit = 0; bit < 252 * 8; ++bit)
      reversed = reversed >> 1 ^ ((reversed & 1) != 0 ? 0xEDB8'8320 : 0);
    std::uint32_t sum = 0;
    for (int bit = 0; bit < 32; ++bit) sum |= (reversed >> bit & 1) << (31 - bit);
    store(program_, 252, sum);
    const std::string_view name = "Astrolabe", board = "rp2040";
    std::copy(name.begin(), name.end(), program_.begin() + 0x140);
    program_[0x14C] = 3;
    program_[0x14D] = 14;
    program_[0x14E] = 15;
    program_[0x14F] = 32;
    std::copy(board.begin(), board.end(), program_.begin() + 0x150);
    for (std::uint32_t number = 0; number < 2; ++number) {
      for (const std::uint32_t word :
           {0x0A32'4655U, 0x9E5D'5157U, 0x2000U, 0x1000'0000U + 256 * number, 256U, number, 2U, 0xE48B'FF56U})
        append(file_, word);
      file_.insert(file_.end(), program_.begin() + 256 * number, program_.begin() + 256 * (number + 1));
      file_.resize(kUf2Block * (number + 1) - 4);
      append(file_, 0x0AB1'6F30U);
    }
  }

  std::filesystem::path path() const { return folder_.path() / "x.uf2"; }
  std::filesystem::path holding(const Bytes& bytes) const {
    std::ofstream(path(), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path();
  }
  /// The file with one word changed.
  Bytes with(std::size_t at, std::uint32_t word) const {
    Bytes bytes = file_;
    store(bytes, at, word);
    return bytes;
  }

  test::TemporaryFolder folder_;
  Bytes program_ = Bytes(512, 0), file_;
};

TEST_F(Uf2File, IsReadToItsPlaceWithVersionAndBoard) {
  const FirmwareImage image = read_uf2_image(holding(file_));
  EXPECT_TRUE(begins_as_uf2(path()));
  EXPECT_TRUE(std::equal(program_.begin(), program_.end(), image.flash.begin()));
  EXPECT_EQ(image.flash[512], 0xFF);
  EXPECT_EQ(image.version, "3.14.15");
  EXPECT_EQ(image.board, "rp2040");
}

TEST_F(Uf2File, WithADamagedBlockIsRefusedByItsNumber) {
  for (const std::size_t at : {0U, 4U, 16U, 20U, 24U, 508U})
    EXPECT_THAT([&] { read_uf2_image(holding(with(kUf2Block + at, 0x1234'5678))); },
                ThrowsTelling(Uf2Problem::damaged, path().string(), "2"))
        << at;
  for (const std::size_t size : {0U, 511U, 513U, 1023U}) {
    Bytes cut = file_;
    cut.resize(size);
    EXPECT_THAT([&] { read_uf2_image(holding(cut)); },
                ThrowsTelling(Uf2Problem::damaged, path().string(), size < 512 ? "1" : "2"))
        << size;
  }
}

TEST_F(Uf2File, OfAnotherChipOrOutsideTheProgramIsForAnotherBoard) {
  for (const auto& [at, word] :
       std::initializer_list<std::pair<std::size_t, std::uint32_t>>{{28, 0xADA5'2840},
                                                                    {8, 0},
                                                                    {12, 0x2000'0000},
                                                                    {12, 0x101F'0000},
                                                                    {12, 0x0FFF'FF00},
                                                                    {12, 0x1000'0080}}) {
    const auto changed = with(kUf2Block + at, word);
    EXPECT_THAT([&] { read_uf2_image(holding(changed)); },
                ThrowsTelling(Uf2Problem::of_other_board, path().string()))
        << at << ' ' << word;
  }
}

TEST_F(Uf2File, ThatTheBootRomWouldNotStartIsDamaged) {
  for (const std::size_t at : {32U, 32U + 248U, 32U + 252U})
    EXPECT_THAT([&] { read_uf2_image(holding(with(at, 1))); },
                ThrowsTelling(Uf2Problem::damaged, path().string(), "1"))
        << at;
}

TEST_F(Uf2File, OfAnybodyElseNamesNoVersion) {
  const FirmwareImage image = read_uf2_image(holding(with(kUf2Block + 32 + 0x40, 0)));
  EXPECT_EQ(image.version, "");
  EXPECT_EQ(image.board, "");
}

TEST_F(Uf2File, FarLargerThanAnyImageIsRefusedUnread) {
  const Bytes large(50'000'000, 0);
  holding(large);
  const support::Taken taken = support::measured([&] {
    EXPECT_THAT([&] { read_uf2_image(path()); }, ThrowsTelling(Uf2Problem::too_large, path().string()));
  });
  EXPECT_BOUNDED(taken, large.size());
}

TEST_F(Uf2File, ThatIsAPipeOrADeviceIsNotWaitedFor) {
  ASSERT_EQ(mkfifo(path().c_str(), 0600), 0);
  EXPECT_FALSE(begins_as_uf2(path()));
  EXPECT_FALSE(begins_as_uf2("/dev/zero"));
  EXPECT_FALSE(begins_as_uf2(folder_.path() / "absent"));
  EXPECT_THAT([&] { read_uf2_image(path()); }, ThrowsTelling(Uf2Problem::unreadable, path().string()));
}

TEST_F(Uf2File, OfRandomBytesIsAnImageOrAnError) {
  constexpr unsigned kSeed = 81;
  std::mt19937 random(kSeed);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    Bytes bytes = file_;
    for (unsigned change = 0; change <= i % 3U; ++change)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    try {
      EXPECT_EQ(read_uf2_image(holding(bytes)).flash.size(), FirmwareImage::kBytes) << "seed " << kSeed;
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 500) << "most bytes that matter are the second stage's and the headers'";
}

}  // namespace
}  // namespace astro
