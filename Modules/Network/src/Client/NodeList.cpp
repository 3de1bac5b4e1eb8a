#include "petrous/Network/NodeList.h"

#include <algorithm>
#include <cstdint>

#include <nlohmann/json.hpp>

#include "petrous/Core/FileLock.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/OutputFile.h"

namespace petrous::network
{
namespace
{

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kFormat = 1;
constexpr std::uintmax_t kLargest = 1 << 20; // bytes

fs::path fileIn(const fs::path& library)
{
  return library / "nodes.json";
}

[[noreturn]] void refuseList(const fs::path& file)
{
  throw core::InvalidParameter(core::printable(file) +
                               ": is not a list of DICOM nodes; remove it and add them again");
}

// A number that the type does not hold does not become another port: checkNode refuses it.
int portIn(const json& j)
{
  return static_cast<int>(std::clamp<std::int64_t>(j.get<std::int64_t>(), -1, 65536));
}

std::vector<Node> readNodes(const fs::path& library)
{
  const fs::path file = fileIn(library);
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    return {};
  const std::string text = core::InputFile(file, kLargest).read();
  std::vector<Node> nodes;
  try
  {
    const json root = json::parse(text);
    const auto format = root.at("format").get<std::int64_t>();
    if (format < 1)
      refuseList(file);
    if (format > kFormat)
      throw core::InvalidParameter(core::printable(file) + ": written by format " +
                                   std::to_string(format) + "; this program reads up to " +
                                   std::to_string(kFormat));
    for (const json& entry : root.at("nodes"))
    {
      Node node;
      node.name = entry.at("name").get<std::string>();
      node.host = entry.at("host").get<std::string>();
      node.port = portIn(entry.at("port"));
      node.aeTitle = entry.at("ae_title").get<std::string>();
      node.callingAeTitle = entry.at("calling_ae_title").get<std::string>();
      node.movePort = entry.contains("move_port") ? portIn(entry.at("move_port")) : 0;
      node.moveHost = entry.value("move_host", "");
      if (entry.contains("tls"))
      {
        const json& tls = entry.at("tls");
        node.tls = TlsFiles{tls.value("ca", ""), tls.value("certificate", ""), tls.value("key", ""),
                            tls.value("name", "")};
      }
      checkNode(node);
      nodes.push_back(std::move(node));
    }
  }
  catch (const json::exception&)
  {
    refuseList(file);
  }
  return nodes;
}

void writeNodes(const fs::path& library, std::vector<Node>& nodes)
{
  std::sort(nodes.begin(), nodes.end(),
            [](const Node& a, const Node& b) { return a.name < b.name; });
  json list = json::array();
  for (const Node& node : nodes)
  {
    json entry{{"name", node.name},
               {"host", node.host},
               {"port", node.port},
               {"ae_title", node.aeTitle},
               {"calling_ae_title", node.callingAeTitle}};
    if (node.movePort != 0)
      entry["move_port"] = node.movePort;
    if (!node.moveHost.empty())
      entry["move_host"] = node.moveHost;
    if (node.tls)
      entry["tls"] = {{"ca", node.tls->authority},
                      {"certificate", node.tls->certificate},
                      {"key", node.tls->key}};
    if (node.tls && !node.tls->name.empty())
      entry["tls"]["name"] = node.tls->name;
    list.push_back(std::move(entry));
  }
  core::writeFile(fileIn(library),
                  json{{"format", kFormat}, {"nodes", std::move(list)}}.dump(2) + "\n");
}

/// For reading and writing the list.
core::FileLock lockList(const fs::path& library)
{
  std::error_code fault;
  fs::create_directories(library, fault);
  return core::FileLock(library / ".nodes.lock");
}

auto named(const std::string& name)
{
  return [&name](const Node& node) { return node.name == name; };
}

[[noreturn]] void refuseUnknown(const std::string& name, const std::vector<Node>& nodes)
{
  std::string there;
  for (const Node& node : nodes)
    there += (there.empty() ? "" : ", ") + node.name;
  throw core::InvalidParameter(
      "no DICOM node '" + (core::isUtf8(name) ? core::printable(name) : "?") + "'; " +
      (there.empty() ? "there is none, see 'petrous nodes add'" : "there are: " + there));
}

} // namespace

NodeList::NodeList(fs::path library)
  : m_library(std::move(library))
  , m_nodes(readNodes(m_library))
{
}

const Node& NodeList::at(const std::string& name) const
{
  const auto found = std::find_if(m_nodes.begin(), m_nodes.end(), named(name));
  if (found == m_nodes.end())
    refuseUnknown(name, m_nodes);
  return *found;
}

void NodeList::add(const Node& node)
{
  checkNode(node);
  const core::FileLock lock = lockList(m_library);
  std::vector<Node> nodes = readNodes(m_library);
  if (std::any_of(nodes.begin(), nodes.end(), named(node.name)))
    throw core::InvalidParameter("a DICOM node '" + node.name +
                                 "' is there already; remove it first, or choose another name");
  nodes.push_back(node);
  writeNodes(m_library, nodes);
  m_nodes = std::move(nodes);
}

void NodeList::replace(const Node& node)
{
  checkNode(node);
  const core::FileLock lock = lockList(m_library);
  std::vector<Node> nodes = readNodes(m_library);
  const auto found = std::find_if(nodes.begin(), nodes.end(), named(node.name));
  if (found == nodes.end())
    refuseUnknown(node.name, nodes);
  *found = node;
  writeNodes(m_library, nodes);
  m_nodes = std::move(nodes);
}

void NodeList::remove(const std::string& name)
{
  const core::FileLock lock = lockList(m_library);
  std::vector<Node> nodes = readNodes(m_library);
  const auto found = std::find_if(nodes.begin(), nodes.end(), named(name));
  if (found == nodes.end())
    refuseUnknown(name, nodes);
  nodes.erase(found);
  writeNodes(m_library, nodes);
  m_nodes = std::move(nodes);
}

} // namespace petrous::network
