// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "yaml/tree.h"

#include <gtest/gtest.h>

#include "base/limits.h"
#include "support/sanitizers.h"

namespace {

using namespace tofray;
using test::often;
using yaml::Node;

std::string refusal(const std::string& text) {
  try {
    yaml::parse_tree(text, "f.yaml");
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

ErrorKind kind_of(const std::string& text) {
  try {
    yaml::parse_tree(text, "f.yaml");
  } catch (const Error& e) {
    return e.kind();
  }
  return ErrorKind::bug;
}

std::string repeat(const std::string& what, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += what;
  return out;
}

// Texts that are no YAML or JSON that tofray takes, each for one reason.
std::vector<std::string> malformed() {
  const std::vector<std::string> broken = {"[",
                                           "{",
                                           "]",
                                           "}",
                                           "[1, 2",
                                           "{a: 1",
                                           "[1, 2}",
                                           "{a: 1]",
                                           "{a: b}}",
                                           "[1]]",
                                           "\"open",
                                           "'open",
                                           "\"\\q\"",
                                           "\"\\xg\"",
                                           "\"\\ud800\"",
                                           "\"\\U99999999\"",
                                           "*",
                                           "&",
                                           "a: \"x\n",
                                           "a: 'x''\n",
                                           "*nope",
                                           "*a b",
                                           "@",
                                           "`",
                                           "!!str x",
                                           "!x y",
                                           "! x",
                                           "!<tag:yaml.org,2002:int> 3",
                                           "<<: {a: 1}",
                                           "[1, 2]: 3",
                                           "{a: 1}: 3",
                                           "? [1]\n: 2",
                                           "a: 1\na: 2",
                                           "{a: 1, a: 2}",
                                           "a: 1\n---\nb: 2",
                                           "--- a\n--- b",
                                           "a: b: c",
                                           "a:\n\tb: 1",
                                           "> a",
                                           "| a",
                                           "- a\n b: 1\n- c\nd",
                                           "a: &x [*x]",
                                           "a: &x {b: *x}",
                                           "a: 1\n b: 2",
                                           "- a\nb: 1",
                                           "%YAML 9\n--- a",
                                           "%YAML\n--- a",
                                           "%TAG\n--- a",
                                           "a: %x",
                                           "{? }: 1,,}",
                                           "[,]x",
                                           "a: 'x' y",
                                           "a: \"x\" y",
                                           "a: [1] 2",
                                           "a: {b: 1} 2",
                                           "\"a\": 1\n\"a\": 2",
                                           "'b': 1\nb: 2",
                                           "[a, b]: [c]",
                                           "{[1]: 2}",
                                           "key: *undefined",
                                           "- - a\n -b",
                                           "{a: 1, b}: c",
                                           "a: &b &c d",
                                           "a: !b !c d",
                                           ": : :",
                                           "null: 1\nnull: 2"};
  const std::vector<std::string> bad_bytes = {"\xff",
                                              "\xfe\xff",
                                              "\xc0\xaf",
                                              "\xc1\x81",
                                              "\x80",
                                              "\xbf",
                                              "\xe2\x82",
                                              "\xe0\x80\x80",
                                              "\xed\xa0\x80",
                                              "\xed\xbf\xbf",
                                              "\xf0\x80\x80\x80",
                                              "\xf4\x90\x80\x80",
                                              "\xf5\x80\x80\x80",
                                              "\xf8\x88\x80\x80\x80",
                                              "\xc3(",
                                              "\xe2(\xa1",
                                              "\xf0(\x8c\xbc",
                                              std::string("\0", 1),
                                              "\x01",
                                              "\x02",
                                              "\x07",
                                              "\x08",
                                              "\x0b",
                                              "\x0c",
                                              "\x0e",
                                              "\x1b[2J",
                                              "\x1f",
                                              "\x7f"};
  // A bad text at the start, as a value, in a list, in a map, behind good lines.
  const std::vector<std::string> frames[] = {
      {"", ""}, {"a: 1\nzebra: ", "\n"}, {"[x, ", ""}, {"# comment\n\nb:\n  - ", "\n"}, {"{\"json\": ", "}"}};
  std::vector<std::string> out;
  for (const auto& bytes : bad_bytes)
    for (const auto& frame : frames) out.push_back(frame[0] + bytes + frame[1]);
  for (const auto& text : broken) {
    out.push_back(text);
    out.push_back("# comment\n\n" + text + "\n");
    out.push_back("\xEF\xBB\xBF" + text);
  }
  return out;
}

TEST(malformed_text, is_refused_with_line_and_column) {
  const auto texts = malformed();
  EXPECT_GE(texts.size(), 300U);
  for (const auto& text : texts) {
    const std::string what = refusal(text);
    EXPECT_TRUE(what.starts_with("f.yaml:")) << "passed, or no place: " << text << " -> " << what;
    int line = 0, column = 0;
    EXPECT_EQ(std::sscanf(what.c_str(), "f.yaml:%d:%d: error: ", &line, &column), 2) << what;
    EXPECT_GE(line, 1);
    EXPECT_GE(column, 1);
    EXPECT_LE(line, 7) << what;
    EXPECT_NE(what.find("\n  "), std::string::npos) << "no second line: " << what;
    for (const char c : what) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << "control character in a message";
  }
}

TEST(malformed_text, is_known_from_its_first_byte_and_its_first_key) {
  EXPECT_NE(refusal("\xFF: 1\n").find("f.yaml:1:1: error: this is not UTF-8 text\n  got the byte 255"), std::string::npos)
      << refusal("\xFF: 1\n");
  const std::pair<const char*, const char*> keys[] = {{"{a: 1,\n [b]: 2}\n", "2:2"},
                                                      {"{a: 1,\n [b, 2]}\n", "2:2"},
                                                      {"? a\n: b\n? - c\n: d\n", "3:3"},
                                                      {"{a: b,\n ? : c}\n", "2:4"},
                                                      {"{é: 1, [ü, ä, ö]: 5}\n", "1:8"}};
  for (const auto& [text, place] : keys)
    EXPECT_NE(refusal(text).find("f.yaml:" + std::string(place) + ": error: a key must be a plain word"), std::string::npos)
        << refusal(text);
}

// What an anchor keeps is memory once more.
TEST(malformed_text, with_anchors_has_as_many_bytes_as_the_limit_and_no_more) {
  const std::string long_text(9 << 20, 'x');
  EXPECT_EQ(refusal("a: " + long_text + "\n"), "");
  EXPECT_NE(refusal("a: &x " + long_text + "\n").find("f.yaml:1:"), std::string::npos);
}

TEST(malformed_text, cut_anywhere_is_a_tree_or_an_error) {
  const std::string text = "a: [1, {b: 'c', \"d\\x41\": &x e}]\nf: |\n  g\n  h\ni: *x\n? j\n: - k\n  - l: m\n";
  EXPECT_EQ(refusal(text), "");
  for (std::size_t cut = 0; cut < text.size(); ++cut) {
    const std::string what = refusal(text.substr(0, cut));
    EXPECT_TRUE(what.empty() || what.starts_with("f.yaml:")) << what;
  }
}

TEST(nesting, is_good_to_64_and_refused_beyond) {
  const int most = static_cast<int>(base::limit::nesting_depth.value);
  EXPECT_EQ(most, 64);
  EXPECT_EQ(refusal(repeat("[", most) + repeat("]", most)), "");
  EXPECT_EQ(kind_of(repeat("[", most + 1) + repeat("]", most + 1)), ErrorKind::limit);
  EXPECT_EQ(refusal(repeat("{a: ", most) + "1" + repeat("}", most)), "");
  EXPECT_EQ(kind_of(repeat("{a: ", most + 1) + "1" + repeat("}", most + 1)), ErrorKind::limit);
  EXPECT_EQ(refusal(repeat("- ", most) + "x"), "");
  EXPECT_EQ(kind_of(repeat("- ", most + 1) + "x"), ErrorKind::limit);
}

TEST(nesting, of_a_million_is_an_error_and_no_crash) {
  for (const char* opener :
       {"[", "{", "- ", "? ", "[a, ", "{a: ", "- [", "&a [", "[[]", "!a ", "'", "\"", "&a ", "*a ", ": ", "--- ", "%a "}) {
    const std::string what = refusal(repeat(opener, often(1'000'000)));
    EXPECT_TRUE(what.empty() || what.starts_with("f.yaml")) << opener;
    if (std::string("[{-").find(opener[0]) != std::string::npos && opener != std::string("--- ")) {
      EXPECT_NE(what, "") << opener;
    }
  }
}

TEST(nesting, cannot_grow_by_aliases) {
  std::string text = "a0: &a0 [x]\n";
  for (int i = 1; i < 100; ++i) text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [*a" + std::to_string(i - 1) + "]\n";
  EXPECT_EQ(kind_of(text), ErrorKind::limit);
}

TEST(aliases, are_written_out_with_the_places_of_their_anchor) {
  const Node root = yaml::parse_tree("a: &x {b: 1}\nc: *x\n", "f.yaml");
  EXPECT_EQ(yaml::flow_text(root), "{a: {b: 1}, c: {b: 1}}");
  EXPECT_EQ(base::to_string(root.find("c")->find("b")->place), "f.yaml:1:11");
}

TEST(aliases, that_multiply_are_stopped_at_the_limit) {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 30; ++i) {
    const std::string alias = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + repeat(alias + ", ", 9) + alias + "]\n";
  }
  EXPECT_EQ(kind_of(text), ErrorKind::limit);
  // Nothing but one anchor, written out again and again: 1,001 values each.
  const std::string once = "a: &a [" + repeat("x, ", 999) + "x]\n";
  EXPECT_EQ(refusal(once + "b: [" + repeat("*a, ", 300) + "]\n"), "");
  EXPECT_EQ(kind_of(once + "b: [" + repeat("*a, ", 500) + "]\n"), ErrorKind::limit);
}

TEST(size, is_limited_on_both_sides_of_the_edge) {
  const auto nodes = static_cast<int>(base::limit::nodes.value);
  EXPECT_EQ(refusal("[" + repeat("1,", nodes - 1) + "]"), "");
  EXPECT_EQ(kind_of("[" + repeat("1,", nodes) + "]"), ErrorKind::limit);
  const auto bytes = static_cast<std::size_t>(base::limit::file_bytes.value);
  EXPECT_EQ(refusal("#" + std::string(bytes - 1, ' ')), "");
  EXPECT_EQ(kind_of("#" + std::string(bytes, ' ')), ErrorKind::limit);
}

TEST(places, count_lines_and_characters_from_one) {
  const Node root = yaml::parse_tree("äöü: 1\nlist:\n  - x\n  - {k: v}\n", "f.yaml");
  EXPECT_EQ(base::to_string(root.items[0].place), "f.yaml:1:6");
  EXPECT_EQ(base::to_string(root.keys[1].place), "f.yaml:2:1");
  EXPECT_EQ(base::to_string(root.find("list")->items[1].items[0].place), "f.yaml:4:9");
}

TEST(json, is_yaml) {
  const Node root = yaml::parse_tree(R"({"a": [1, "x\n\/", true], "b": {"c": null}})", "f.json");
  EXPECT_EQ(root.find("a")->items[1].text, "x\n/");
  EXPECT_TRUE(root.find("a")->items[1].quoted);
  EXPECT_EQ(root.find("b")->items[0].kind, Node::Kind::null);
}

TEST(flow_text, reads_back_to_the_same_tree) {
  for (const char* text :
       {"{a: 1, b: [x, 'true', \"null\", '5 %', \"\\x01\\\"\", '', \"- x\", '# no', 'a: b', \"ä\"], 'c d': {}, e: [], f: null}", "x",
        "[[[]]]", "'%x'", "'--- x'", "'- x'", "'-'", "'..'", "'...'", "'--'", "{a: '-', '- b': '- c', '-': ['-', '- d']}"}) {
    const Node once = yaml::parse_tree(text, "f.yaml");
    EXPECT_EQ(yaml::flow_text(yaml::parse_tree(yaml::flow_text(once), "g.yaml")), yaml::flow_text(once)) << text;
  }
}

}  // namespace

TEST(json, may_escape_characters_as_surrogate_pairs_and_hold_delete) {
  // What Python's json.dumps writes: RFC 8259, section 7.
  const Node root = yaml::parse_tree(R"({"a": "\ud83d\ude00 \uD834\udd1e \u00e9 \\ud83d\\ude00", "b": "x)"
                                     "\x7F"
                                     R"("})",
                                     "f.json");
  EXPECT_EQ(root.find("a")->text, "\xF0\x9F\x98\x80 \xF0\x9D\x84\x9E \xC3\xA9 \\ud83d\\ude00");
  EXPECT_EQ(root.find("b")->text, "x\x7F");
  EXPECT_EQ(yaml::parse_value(R"("\udbff\udfff")", base::whole("--set")).text, "\xF4\x8F\xBF\xBF");
  for (const char* const alone :
       {R"({"a": "\ud83d"})", R"({"a": "\ude00"})", R"({"a": "\ud83d\u0041"})", R"({"a": "\ud83d\ud83d"})", R"({"a": "\ud83d)"})
    EXPECT_NE(refusal(alone), "") << alone;
  // Only JSON has them: elsewhere a backslash may be one.
  EXPECT_EQ(yaml::parse_tree("a: '\\ud83d\\ude00'\n", "f.yaml").find("a")->text, "\\ud83d\\ude00");
  EXPECT_NE(refusal("a: x\x7F\n"), "");
}

TEST(json, with_surrogate_pairs_has_faults_in_their_own_columns) {
  const std::string text = R"({"a": "\ud83d\ude00\ud83d\ude00", "b": 1,)"
                           "\n"
                           R"( "c": "\ud83d\ude00", "c": 2})";
  EXPECT_EQ(refusal(text).rfind("f.yaml:2:23: error: the key \"c\" stands twice", 0), 0U) << refusal(text);
}
