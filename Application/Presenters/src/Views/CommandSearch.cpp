#include "petrous/Presenters/CommandSearch.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "petrous/Scene/Description.h"

namespace petrous::presenters
{

namespace
{

constexpr int kNotFound = 5;

std::vector<std::string> wordsIn(const std::string& text)
{
  std::istringstream stream(text);
  std::vector<std::string> found;
  for (std::string word; stream >> word;)
    found.push_back(word);
  return found;
}

// Bytes of UTF-8 beyond ASCII belong to words.
bool isInWord(char c)
{
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || (byte >= '0' && byte <= '9') || (byte >= 'a' && byte <= 'z');
}

bool beginsWord(const std::string& text, const std::string& word)
{
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    if (at == 0 || !isInWord(text[at - 1]))
      return true;
  return false;
}

int rankOf(const CommandEntry& command, const std::string& search,
           const std::vector<std::string>& words)
{
  const std::string name = scene::lowerCase(command.name);
  const std::string place = name + ' ' + scene::lowerCase(command.menu);
  const std::string all = place + ' ' + scene::lowerCase(command.tip);
  const auto each = [&words](auto holds) { return std::all_of(words.begin(), words.end(), holds); };
  if (name.compare(0, search.size(), search) == 0)
    return 0;
  if (each([&](const std::string& word) { return beginsWord(name, word); }))
    return 1;
  if (each([&](const std::string& word) { return name.find(word) != std::string::npos; }))
    return 2;
  if (each([&](const std::string& word) { return place.find(word) != std::string::npos; }))
    return 3;
  if (each([&](const std::string& word) { return all.find(word) != std::string::npos; }))
    return 4;
  return kNotFound;
}

} // namespace

std::vector<std::size_t> findCommands(const std::vector<CommandEntry>& commands,
                                      const std::string& search)
{
  const std::vector<std::string> words = wordsIn(scene::lowerCase(search));
  std::string joined;
  for (const std::string& word : words)
    joined += (joined.empty() ? "" : " ") + word;
  std::vector<std::pair<int, std::size_t>> ranked;
  for (std::size_t n = 0; n < commands.size(); ++n)
    if (const int rank = rankOf(commands[n], joined, words); rank < kNotFound)
      ranked.emplace_back(rank, n);
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::size_t> found;
  for (const auto& [rank, n] : ranked)
    found.push_back(n);
  return found;
}

} // namespace petrous::presenters
