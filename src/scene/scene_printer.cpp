// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_printer.h"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "scene/parameter_reader.h"
#include "scene/parser.h"
#include "shapes/ply_writer.h"

namespace lampyris {

namespace {

constexpr size_t kLineLength = 100, kIndent = 2, kParameterIndent = 4;
constexpr size_t kBufferSize = 1 << 16;

bool opens(std::string_view word) {
  return word == "AttributeBegin" || word == "TransformBegin" || word == "ObjectBegin";
}
bool closes(std::string_view word) {
  return word == "AttributeEnd" || word == "TransformEnd" || word == "ObjectEnd";
}

/// Parameters of triangle meshes that PLY files take in, or that mean nothing beside them.
bool isPartOfMesh(std::string_view name) {
  for (const char* part : {"P", "N", "uv", "st", "indices", "faceIndices"})
    if (name == part) return true;
  return false;
}

/// `declaration` is text like "point P".
std::string_view nameOf(std::string_view declaration) {
  const size_t end = declaration.find_last_not_of(" \t") + 1;
  const size_t begin = declaration.find_last_of(" \t", end > 0 ? end - 1 : 0) + 1;
  return declaration.substr(begin, end - begin);
}

template <class V>
std::vector<V> grouped(const Parameter* p) {
  constexpr size_t kSize = sizeof(V) / sizeof(float);
  std::vector<V> all;
  if (!p || p->floats.size() % kSize != 0) return all;
  for (size_t i = 0; i < p->floats.size(); i += kSize) {
    V v;
    for (size_t k = 0; k < kSize; ++k) v[static_cast<glm::length_t>(k)] = p->floats[i + k];
    all.push_back(v);
  }
  return all;
}

/// The mesh that `set` describes; none if a PLY file would not hold all of it, or if it is faulty.
std::optional<TriangleMeshData> meshOf(const ParameterSet& set) {
  for (size_t i = 0; i < set.parameters.size(); ++i)
    for (size_t k = 0; k < i; ++k)
      if (set.parameters[i].name == set.parameters[k].name) return std::nullopt;
  const Parameter *uv = set.find("uv"), *st = set.find("st"), *indices = set.find("indices");
  if (!indices || (uv && st) || set.find("S")) return std::nullopt;
  TriangleMeshData mesh;
  mesh.positions = grouped<Vec3>(set.find("P"));
  mesh.normals = grouped<Vec3>(set.find("N"));
  mesh.uvs = grouped<Vec2>(uv ? uv : st);
  const size_t count = mesh.positions.size();
  const bool whole = (!set.find("N") || mesh.normals.size() == count) &&
                     (!(uv || st) || mesh.uvs.size() == count) &&
                     indices->integers.size() % 3 == 0 && !indices->integers.empty();
  if (!whole) return std::nullopt;
  for (const int32_t i : indices->integers) {
    if (i < 0 || static_cast<size_t>(i) >= count) return std::nullopt;
    mesh.indices.push_back(static_cast<uint32_t>(i));
  }
  return mesh;
}

class Printer {
 public:
  Printer(std::string folder, const PrintOptions& options, SourceFiles& files,
          const std::function<void(std::string_view)>& out)
      : folder_(std::move(folder)), options_(options), files_(files), out_(out) {}

  void run(uint16_t mainFile) {
    printFile(mainFile);
    if (!worldEnded_) startLine("WorldEnd", 0);
    text_ += '\n';
    out_(text_);
  }

 private:
  void printFile(uint16_t file);
  void printDirective(Tokenizer& in);
  void printArguments(Tokenizer& in, bool withoutMesh);
  bool printMesh(Tokenizer& in);
  std::string_view takeToken(Tokenizer& in);
  void startLine(std::string_view text, size_t indent);
  void append(std::string_view text);

  const std::string folder_;
  const PrintOptions options_;
  SourceFiles& files_;
  const std::function<void(std::string_view)>& out_;
  std::map<std::string, uint16_t> included_;
  std::string text_;    ///< not yet handed out
  std::string quoted_;  ///< of takeToken()
  size_t column_ = 0, depth_ = 0, meshes_ = 0;
  bool started_ = false, worldEnded_ = false;
};

void Printer::startLine(std::string_view text, size_t indent) {
  if (text_.size() > kBufferSize) {
    out_(text_);
    text_.clear();
  }
  if (started_) text_ += '\n';
  started_ = true;
  text_.append(indent, ' ');
  text_ += text;
  column_ = indent + text.size();
}

/// To the line, or to the next one where there is no room.
void Printer::append(std::string_view text) {
  if (column_ + 1 + text.size() > kLineLength) {
    startLine(text, kIndent * depth_ + kParameterIndent);
    return;
  }
  text_ += ' ';
  text_ += text;
  column_ += 1 + text.size();
}

void Printer::printFile(uint16_t file) {
  Tokenizer in(files_.text(file), file);
  while (!worldEnded_ && in.peek() != TokenKind::End) printDirective(in);
}

void Printer::printDirective(Tokenizer& in) {
  const std::string_view word = in.readWord();
  if (word == "Include") {
    in.peek();
    const SourceLocation where = in.location();
    const auto name = in.readString();
    const std::string path = resolveScenePath(
        folder_, name.escaped ? unescape(name.text, where) : std::string(name.text));
    auto known = included_.find(path);
    if (known == included_.end()) known = included_.emplace(path, files_.open(path)).first;
    printFile(known->second);
    return;
  }
  if (closes(word) && depth_ > 0) --depth_;
  startLine(word, kIndent * depth_);
  if (opens(word)) ++depth_;
  worldEnded_ = word == "WorldEnd";
  if (word == "ActiveTransform") {
    in.peek();
    append(in.readWord());
  }
  const bool toPly = options_.meshesToPly && word == "Shape" && printMesh(in);
  if (!toPly) printArguments(in, false);
}

/// The next token as it was written; empty where the next directive or the end is.
std::string_view Printer::takeToken(Tokenizer& in) {
  const TokenKind kind = in.peek();
  if (kind == TokenKind::End) return {};
  if (kind == TokenKind::String) return quoted_ = fmt::format("\"{}\"", in.readString().text);
  if (kind == TokenKind::Word) {
    Tokenizer ahead = in;
    const std::string_view word = ahead.readWord();
    if (!in.atNumber() && word != "true" && word != "false") return {};
    in = ahead;
    return word;
  }
  in.skipBracket();
  return kind == TokenKind::Open ? "[" : "]";
}

/// What stands up to the next directive; a line for each parameter.
void Printer::printArguments(Tokenizer& in, bool withoutMesh) {
  bool inList = false, skips = false, isValue = false;
  for (size_t strings = withoutMesh ? 1 : 0;;) {
    const std::string_view token = takeToken(in);
    if (token.empty()) return;
    const bool isString = token[0] == '"' && !inList;
    const std::string_view text = isString ? token.substr(1, token.size() - 2) : token;
    const bool declares =
        isString && !isValue && strings > 0 && text.find_first_of(" \t") != std::string_view::npos;
    isValue = declares;
    strings += isString ? 1 : 0;
    inList = token == "[" || (inList && token != "]");
    if (declares) skips = withoutMesh && isPartOfMesh(nameOf(text));
    if (skips) continue;
    if (declares)
      startLine(token, kIndent * depth_ + kParameterIndent);
    else
      append(token);
  }
}

/// A triangle mesh as a PLY file and what names it; false, and nothing is taken, if it is none.
bool Printer::printMesh(Tokenizer& in) {
  Tokenizer ahead = in;
  if (ahead.peek() != TokenKind::String || ahead.readString().text != "trianglemesh") return false;
  Description scratch;
  ParameterReader(scratch).read(ahead);
  const auto mesh = meshOf({scratch.parameters.take(), in.location()});
  if (!mesh) return false;
  const std::string name = fmt::format("mesh_{:05}.ply", ++meshes_);
  writePly(resolveScenePath(folder_, name), *mesh);
  in.peek();
  in.readString();
  append("\"plymesh\"");
  startLine("\"string filename\"", kIndent * depth_ + kParameterIndent);
  append(fmt::format("[ \"{}\" ]", name));
  printArguments(in, true);
  return true;
}

}  // namespace

void printScene(uint16_t mainFile, const std::string& folder, const PrintOptions& options,
                SourceFiles& files, Diagnostics& diagnostics,
                const std::function<void(std::string_view)>& out) {
  parseScene(mainFile, folder, files, diagnostics);
  Printer(folder, options, files, out).run(mainFile);
}

}  // namespace lampyris
