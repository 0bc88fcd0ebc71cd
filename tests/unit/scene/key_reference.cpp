// Markdown and JSON Schema from the table of keys.
#include "unit/scene/key_reference.h"

#include <algorithm>

#include "scene/keys.h"
#include "scene/node.h"

namespace brickfall::scene {

namespace {

using K = KeyKind;

std::string fullName(const KeySpec& spec) {
  return *spec.table ? std::string(spec.table) + "." + spec.key : std::string(spec.key);
}

std::string rangeOf(const KeySpec& spec) { return numberText(spec.minimum) + " .. " + numberText(spec.maximum); }

std::string typeWords(const KeySpec& spec) {
  switch (spec.kind) {
    case K::number:
      return "number";
    case K::integer:
      return "whole number";
    case K::boolean:
      return "true or false";
    case K::text:
    case K::name:
    case K::choice:
      return "text";
    case K::material:
      return "name of a material";
    case K::mortarKind:
      return "name of a mortar";
    case K::mortar:
      return "name of a mortar or [" + fullName(spec) + "]";
    case K::colour:
      return "colour";
    case K::vector:
    case K::positive:
      return "[x, y, z]";
    case K::counts:
      return "[x, y, z], whole";
    case K::gravity:
      return "number or [x, y, z]";
    case K::brick:
      return "name of a brick or [l, h, w]";
    case K::pair:
      return "[a, b]";
    case K::wholePair:
      return "[a, b], whole";
    case K::points:
      return "[[x, y, z], ...]";
    case K::times:
      return "[t, ...]";
    case K::numbers:
      return "[a, ...], whole";
    case K::planPoints:
      return "[[x, z], ...]";
    case K::texts:
      return "text or [text, ...]";
    case K::repeat:
      return "whole number or [repeat]";
    case K::parameters:
      return *spec.table ? "table of numbers" : "[parameters]";
    case K::table:
      return "[" + fullName(spec) + "]";
    case K::tables:
      break;
  }
  return "[[" + fullName(spec) + "]]";
}

std::string rangeWords(const KeySpec& spec) {
  std::string choices;
  for (const std::string& choice : choicesOf(spec)) choices += (choices.empty() ? "`\"" : ", `\"") + choice + "\"`";
  switch (spec.kind) {
    case K::number:
    case K::integer:
    case K::repeat:
      return rangeOf(spec);
    case K::numbers:
    case K::planPoints:
    case K::vector:
    case K::positive:
    case K::counts:
    case K::gravity:
    case K::points:
    case K::times:
      return "each " + rangeOf(spec);
    case K::brick:
    case K::pair:
    case K::wholePair:
      return "each " + rangeOf(spec);
    case K::choice:
      return choices;
    case K::text:
      return "up to " + numberText(spec.maximum) + " characters";
    case K::name:
      return "1 .. 64 characters";
    case K::colour:
      return "`\"#RRGGBB\"`";
    default:
      return "";
  }
}

std::string fallbackWords(const KeySpec& spec) {
  std::string text = spec.fallback;
  return text.empty() ? "**must be given**" : text == "-" ? "" : "`" + text + "`";
}

std::string inQuotes(const std::string& text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string numberSchema(const KeySpec& spec, bool whole) {
  return std::string("{\"anyOf\": [{\"type\": \"") + (whole ? "integer" : "number") +
         "\", \"minimum\": " + numberText(spec.minimum) + ", \"maximum\": " + numberText(spec.maximum) +
         "}, {\"$ref\": \"#/definitions/expression\"}]}";
}

std::string arraySchema(const std::string& item, int least, int most) {
  return "{\"type\": \"array\", \"minItems\": " + std::to_string(least) + ", \"maxItems\": " + std::to_string(most) +
         ", \"items\": " + item + "}";
}

std::string tableSchema(const std::string& table, const std::string& indent);

std::string valueSchema(const KeySpec& spec, const std::string& indent) {
  std::string number = numberSchema(spec, false);
  std::string choices;
  for (const std::string& choice : choicesOf(spec)) choices += (choices.empty() ? "" : ", ") + inQuotes(choice);
  switch (spec.kind) {
    case K::number:
      return number;
    case K::integer:
      return numberSchema(spec, true);
    case K::boolean:
      return "{\"type\": \"boolean\"}";
    case K::text:
      return "{\"type\": \"string\", \"maxLength\": " + numberText(spec.maximum) + "}";
    case K::name:
      return "{\"type\": \"string\", \"minLength\": 1, \"maxLength\": 64}";
    case K::material:
    case K::mortarKind:
      return "{\"type\": \"string\"}";
    case K::mortar:
      return "{\"anyOf\": [{\"type\": \"string\"}, " + tableSchema(fullName(spec), indent) + "]}";
    case K::choice:
      return "{\"enum\": [" + choices + "]}";
    case K::colour:
      return "{\"type\": \"string\", \"pattern\": \"^#[0-9A-Fa-f]{6}$\"}";
    case K::vector:
    case K::positive:
      return arraySchema(number, 3, 3);
    case K::counts:
      return arraySchema(numberSchema(spec, true), 3, 3);
    case K::gravity:
      return "{\"anyOf\": [" + number + ", " + arraySchema(number, 3, 3) + "]}";
    case K::brick:
      return "{\"anyOf\": [{\"type\": \"string\"}, " + arraySchema(number, 3, 3) + "]}";
    case K::pair:
      return arraySchema(number, 2, 2);
    case K::wholePair:
      return arraySchema(numberSchema(spec, true), 2, 2);
    case K::points:
      return arraySchema(arraySchema(number, 3, 3), 4, 64);
    case K::times:
      return arraySchema(number, 1, 1000);
    case K::numbers:
      return arraySchema(numberSchema(spec, true), 0, 1000);
    case K::planPoints:
      return arraySchema(arraySchema(number, 2, 2), 2, 1000);
    case K::texts:
      return "{\"anyOf\": [{\"type\": \"string\"}, " + arraySchema("{\"type\": \"string\"}", 0, 100) + "]}";
    case K::repeat:
      return "{\"anyOf\": [{\"type\": \"integer\", \"minimum\": 0}, {\"$ref\": \"#/definitions/expression\"}, "
             "{\"$ref\": \"#/definitions/repeat\"}]}";
    case K::parameters:
      return "{\"type\": \"object\", \"additionalProperties\": {\"anyOf\": [{\"type\": \"number\"}, "
             "{\"$ref\": \"#/definitions/expression\"}]}}";
    case K::table:
      return tableSchema(fullName(spec), indent);
    case K::tables:
      break;
  }
  if (std::string(spec.table) == "group")
    return std::string("{\"type\": \"array\", \"items\": {\"$ref\": \"#/properties/") + spec.key + "/items\"}}";
  return "{\"type\": \"array\", \"items\": " + tableSchema(fullName(spec), indent) + "}";
}

std::string describedSchema(const KeySpec& spec, const std::string& indent) {
  std::string schema = valueSchema(spec, indent);
  std::string words = spec.meaning;
  if (*spec.unit) words += std::string(" (") + spec.unit + ")";
  std::string head = "{\"description\": " + inQuotes(words) + ", ";
  bool literal = *spec.fallback && std::string(spec.fallback) != "-";
  if (literal) head += "\"default\": " + std::string(spec.fallback) + ", ";
  return head + schema.substr(1);
}

std::string tableSchema(const std::string& table, const std::string& indent) {
  std::string inner = indent + "    ", required, properties;
  for (const KeySpec& spec : keySpecs()) {
    if (spec.table != table) continue;
    if (!*spec.fallback) required += (required.empty() ? "" : ", ") + inQuotes(spec.key);
    properties += (properties.empty() ? "" : ",\n") + inner + inQuotes(spec.key) + ": " + describedSchema(spec, inner);
  }
  // A copy has the keys of what it copies.
  std::string out = "{\"type\": \"object\", \"additionalProperties\": ";
  out += table == "copy" ? "true, " : "false, ";
  if (!required.empty()) out += "\"required\": [" + required + "], ";
  return out + "\"properties\": {\n" + properties + "\n" + indent + "  }}";
}

}  // namespace

std::vector<std::string> tablesOfKeys() {
  std::vector<std::string> tables;
  for (const KeySpec& spec : keySpecs())
    if (std::find(tables.begin(), tables.end(), spec.table) == tables.end()) tables.push_back(spec.table);
  return tables;
}

std::string keyMarkdown(const std::string& table) {
  std::string out = "| key | type | unit | range | default | meaning |\n|---|---|---|---|---|---|\n";
  for (const KeySpec& spec : keySpecs())
    if (spec.table == table)
      out += std::string("| `") + spec.key + "` | " + typeWords(spec) + " | " + spec.unit + " | " + rangeWords(spec) +
             " | " + fallbackWords(spec) + " | " + spec.meaning + " |\n";
  return out;
}

std::string keySchema() {
  std::string top = tableSchema("", "");
  return "{\"$schema\": \"http://json-schema.org/draft-07/schema#\",\n"
         "  \"title\": \"Brickfall scene\",\n"
         "  \"definitions\": {\"expression\": {\"type\": \"string\", \"pattern\": \"[$0-9]\", "
         "\"description\": \"arithmetic on numbers and $parameters\"},\n  \"repeat\": " +
         tableSchema("repeat", "  ") + "},\n  " + top.substr(1) + "\n";
}

}  // namespace brickfall::scene
