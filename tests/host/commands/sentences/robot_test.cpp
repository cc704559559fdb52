#include "tests/host/commands/sentences/sentences.hpp"

// The whole sentences about images for the robot, the simulator, studies, tags and files of unknown kind.
namespace astro {
namespace {

class OtherSentences : public support::Sentences {
 protected:
  static void shard(const std::string& part, const std::string& file, const std::string& more = "") {
    EXPECT_EQ(support::sentence_of("study --runs 1 --side 0.5 --trials 3 --shard " + part + " --out " + file +
                                   more),
              "no error, but the exit code 0");
  }
};

TEST_F(OtherSentences, TellWhatIsWrongWithAnImage) {
  write("table.hex", "time_s,left_counts\n1,2\n");
  write("other.hex", ":00000001FF\n");
  write("low.hex", ":10000000000102030405060708090A0B0C0D0E0F78\n");
  write("empty.hex", "");
  write("empty.uf2", "");
  expect({
      {"no file", "flash none.hex --button", "cannot read 'none.hex': build one with './dev firmware'"},
      {"no Intel HEX", "flash table.hex --button",
       "table.hex:1 is no Intel HEX record: build the image again"},
      {"nothing for this board", "flash other.hex --button",
       "'other.hex' is no image for a Teensy 4.0: build one with './dev firmware'"},
      {"another board's addresses", "flash low.hex --button",
       "low.hex:1 lies at 0x00000000, where a Teensy 4.0 has no program memory"},
      {"cut off", "flash empty.hex --button", "'empty.hex' has no end: build the image again"},
      {"no file for a Pico", "flash none.uf2 --button",
       "cannot read 'none.uf2': build one with './dev firmware rp2040'"},
      {"cut off, for a Pico", "flash empty.uf2 --button",
       "'empty.uf2' ends within a block of UF2: build or copy it again; './dev firmware rp2040' builds one"},
  });
}

TEST_F(OtherSentences, TellWhereNoSimulatorCanBe) {
  write("file", "mine");
  std::filesystem::create_directory("folder");
  std::filesystem::create_symlink("nowhere", "link");
  expect({
      {"a file of somebody else", "sim --pty file",
       "'file' exists and is not a simulator's: choose another path for --pty"},
      {"a folder", "sim --pty folder",
       "'folder' exists and is not a simulator's: choose another path for --pty"},
      {"a flash that is a link", "sim --pty pty --flash link",
       "'link' is a link, and saving the robot's flash would replace the link: name the file itself"},
      {"a flash that is a folder", "sim --pty pty --flash folder", "--flash: 'folder' is not a file"},
      {"a flash of another size", "sim --pty pty --flash file",
       "--flash: 'file' has 4 bytes and a robot's flash 24576: it is another file"},
  });
  EXPECT_EQ(text_of("file"), "mine");
}

TEST_F(OtherSentences, TellWhyShardsDoNotMerge) {
  shard("1/2", "one.json");
  shard("2/2", "two.json");
  shard("2/2", "seed.json", " --seed 9");
  write("table.json", "time_s,left_counts\n1,2\n");
  write("object.json", "{}\n");
  const auto changed = [](const std::string& name, const std::string& from, const std::string& to) {
    std::string text = text_of("two.json");
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write(name, text.replace(at, from.size(), to));
  };
  changed("version.json", "\"format\": \"", "\"format\": \"old ");
  changed("index.json", "\"trial\": 2", "\"trial\": 20");
  expect({
      {"a table", "study merge one.json table.json",
       "'table.json' is not a shard of a study: give what 'astrolabe study --out' wrote"},
      {"another object", "study merge one.json object.json",
       "'object.json' is not a shard of a study: give what 'astrolabe study --out' wrote"},
      {"another version", "study merge one.json version.json",
       "'version.json' was written by another version of the study: run its shard of 'astrolabe study' "
       "again"},
      {"a trial that the study does not have", "study merge one.json index.json",
       "'index.json' holds trial 20 of a study of 3; it is damaged: run its shard of 'astrolabe study' "
       "again"},
      {"the same twice", "study merge one.json one.json",
       "trial 0 is in 'one.json' and in 'one.json': name each shard once"},
      {"two studies", "study merge one.json seed.json",
       "'one.json' was made with seed 1 and 'seed.json' with 9: merge shards of one study only"},
      {"a shard is missing", "study merge two.json",
       "of 3 trials number 0 is missing: run the shard, or name its file, too"},
      {"another shard is missing", "study merge one.json",
       "of 3 trials 1 to 2 are missing: run the shard, or name its file, too"},
      {"no file", "study merge one.json none.json", "none.json does not exist: check the path"},
      {"an empty shard", "study --trials 2 --shard 3/4 --out part.json",
       "shard 3/4 of 2 trials is empty: make fewer shards or more trials"},
      {"a shard without a file", "study --trials 2 --shard 1/4",
       "--shard makes a part for 'study merge': say with --out where to put it"},
      {"a shard that is to print", "study --trials 2 --shard 1/4 --out part.json --json",
       "--shard prints no result: give --json to 'study merge'"},
  });
}

TEST_F(OtherSentences, TellWhyThereAreNoTags) {
  write("table.pdf", "time_s,left_counts\n1,2\n");
  expect({
      {"the robot's tag on the floor", "tags --pdf tags.pdf --floor-ids 0,1",
       "tag 0 would be there twice: give each tag an id of its own with --robot-id and --floor-ids"},
      {"a tag twice on the floor", "tags --pdf tags.pdf --floor-ids 1,1",
       "tag 1 would be there twice: give each tag an id of its own with --robot-id and --floor-ids"},
      {"a file of somebody else", "tags --pdf table.pdf",
       "'table.pdf' exists and is no PDF of this program, as what would replace it is: remove it or name "
       "another file"},
      {"too large for the paper", "tags --pdf tags.pdf --robot-side 200 --paper a4",
       "--robot-side 200: with its white margin and the ruler it does not fit on a4 paper, where 168 mm is "
       "the most"},
  });
}

TEST_F(OtherSentences, TellThatAFileIsOfNoKnownKind) {
  std::filesystem::create_directory("drives");
  write("empty.csv", "");
  write("names.csv", "time_s,a,b\n1,2,3\n");
  write("text.mcap", "nothing that was recorded\n");
  write("begin.mcap", std::string("\x89MCAQ0\r\n\0", 9));
  write("zero.bin", std::string(300, '\0'));
  write("open.toml", "[parameters\n");
  write("other.toml", "c = 1\n");
  write("open.yaml", "a: [1\n");
  write("other.yaml", "a: 1\n");
  write("text.db3", std::string("SQLite format 3\0abc", 19));
  expect({
      {"no file", "inspect none", "none does not exist: check the path"},
      {"an empty folder", "inspect drives", "drives is a folder: name a file in it"},
      {"an empty file", "inspect empty.csv", "'empty.csv' is empty"},
      {"columns without a meaning", "inspect names.csv",
       "names.csv: no columns are named as the left and the right wheel; the columns are time_s, a, b: say "
       "what they are with --wheel-columns, such as time_s,left_counts,right_counts (also ..._rad, ..._m, "
       "..._rad_s, ..._rpm, ..._m_s; - for one that is not used)"},
      {"text with the name of a recording", "inspect text.mcap",
       "text.mcap is not a bag: it begins like no .db3, .mcap, .bag or .zstd file: name the right file"},
      {"a recording with a damaged beginning", "inspect begin.mcap",
       "begin.mcap is not a bag: it begins like no .db3, .mcap, .bag or .zstd file: name the right file"},
      {"zeros", "inspect zero.bin",
       "zero.bin is not plain text: byte 1 is zero: save the table as comma separated UTF-8"},
      {"cut off", "inspect open.toml",
       "'open.toml' line 1 is not TOML: Error while parsing table header: expected ']', saw '\\n'"},
      {"TOML of something else", "inspect other.toml",
       "'other.toml' has no [parameters]: it is no calibration and no export of a robot's parameters"},
      {"YAML that is cut off", "inspect open.yaml",
       "open.yaml, line 2: this is not YAML: did not find expected ',' or ']': name the right file"},
      {"YAML of something else", "inspect other.yaml",
       "other.yaml has no wheel_radius and no wheel_separation of a controller: name the right file"},
      {"no database", "inspect text.db3", "text.db3 is not a database: name the right file"},
  });
}

}  // namespace
}  // namespace astro
