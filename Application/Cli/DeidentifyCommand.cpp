#include <algorithm>
#include <iostream>
#include <memory>

#include <termios.h>
#include <unistd.h>

#include "Commands.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/Deidentification.h"
#include "petrous/Library/PseudonymMap.h"
#include "petrous/Presenters/FolderIdentity.h"
#include "petrous/Scene/Description.h"

namespace petrous::cli
{

namespace
{

using nlohmann::json;

struct DeidentifyCommandOptions
{
  std::string input, output, dates = "remove", map, passphraseFile, report;
  library::DeidentificationOptions profile;
  bool replace = false, strict = false;
};

struct PseudonymsCommandOptions
{
  std::string map, passphraseFile, find, import, copy, otherPassphraseFile, newPassphraseFile;
  bool changePassphrase = false;
};

/// A line from the terminal, without echo.
std::string askedPassphrase(const std::string& prompt)
{
  if (::isatty(STDIN_FILENO) == 0)
    throw UsageError("the pseudonym map needs a passphrase; give --passphrase-file FILE");
  struct NoEcho
  {
    termios before{};
    NoEcho()
    {
      ::tcgetattr(STDIN_FILENO, &before);
      termios silent = before;
      silent.c_lflag &= ~static_cast<tcflag_t>(ECHO);
      ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &silent);
    }
    ~NoEcho()
    {
      ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before);
      std::cerr << '\n';
    }
  } noEcho;
  std::cerr << prompt << std::flush;
  std::string line;
  std::getline(std::cin, line);
  return line;
}

/// From the file's first line, else asked for; `twice`: as it is new.
std::string passphraseFrom(const std::string& file, const std::string& of, bool twice)
{
  constexpr std::uintmax_t kLargest = 4096;
  if (!file.empty())
  {
    const std::string text = core::readFile(file, kLargest);
    return text.substr(0, text.find_first_of("\r\n"));
  }
  std::string passphrase = askedPassphrase("Passphrase of " + of + ": ");
  if (twice && askedPassphrase("The same once more, as it is new: ") != passphrase)
    throw UsageError("the two passphrases differ");
  return passphrase;
}

std::string passphraseFor(const std::string& map, const std::string& file)
{
  std::error_code error;
  return passphraseFrom(file, "the pseudonym map", !std::filesystem::exists(map, error));
}

json reportJson(const library::DeidentificationReport& report)
{
  json stays = json::array(), changed = json::array();
  for (const auto& line : report.lines)
    (line.stays ? stays : changed)
        .push_back({{"attribute", line.attribute},
                    {"name", line.name},
                    {"why", line.action},
                    {"files", line.files}});
  return {{"table", report.edition},
          {"options", report.options},
          {"files", report.filesWritten},
          {"patients", report.patients},
          {"left_out", report.leftOut},
          {"warnings", report.warnings},
          {"stays", stays},
          {"removed_or_replaced", changed}};
}

void deidentify(const Context& context, DeidentifyCommandOptions options)
{
  using Dates = library::DeidentificationOptions::Dates;
  if (!options.report.empty())
    presenters::refuseWithin(options.report, options.input, "report");
  context.refuseOverwriting({options.output, options.map, options.report},
                            {options.input, options.passphraseFile});
  options.profile.dates = options.dates == "keep"    ? Dates::Keep
                          : options.dates == "shift" ? Dates::Shift
                                                     : Dates::Remove;
  std::string passphrase;
  if (!options.map.empty())
    passphrase = passphraseFor(options.map, options.passphraseFile);
  else if (!options.passphraseFile.empty())
    throw UsageError("--passphrase-file: there is no --map that it could open");
  const library::DeidentificationResult done = presenters::deidentifyFolder(
      {options.input, options.output, options.map, options.profile, options.replace}, passphrase,
      context.progress());
  for (const std::string& line : done.leftOut)
    context.warn("left out: " + line);
  for (const auto& [what, files] : done.report.warnings)
    context.warn("warning: " + std::to_string(files) + (files == 1 ? " file: " : " files: ") +
                 what);
  if (!done.report.durable)
    context.warn(options.output + ": is written, but the disk reported an error; check the disk");
  if (!options.report.empty())
    core::writeFile(options.report, std::filesystem::path(options.report).extension() == ".json"
                                        ? jsonText(reportJson(done.report))
                                        : done.report.text());
  context.print(std::to_string(done.report.filesWritten) + " files are de-identified in " +
                options.output);
  context.printJson(reportJson(done.report));
  if (options.strict && !done.leftOut.empty())
    throw core::InvalidParameter(options.input + ": " + std::to_string(done.leftOut.size()) +
                                 (done.leftOut.size() == 1 ? " file was" : " files were") +
                                 " left out, and --strict wants none");
}

bool contains(const library::Pseudonym& entry, const std::string& text)
{
  const std::string wanted = scene::lowerCase(text);
  for (const std::string* one : {&entry.kind, &entry.pseudonym, &entry.identity})
    if (scene::lowerCase(*one).find(wanted) != std::string::npos)
      return true;
  return false;
}

// What changes the map or copies it lists nothing.
void changePseudonyms(const Context& context, const PseudonymsCommandOptions& options,
                      library::PseudonymMap& map)
{
  context.refuseOverwriting({options.copy}, {options.map, options.import, options.passphraseFile});
  if (!options.import.empty())
  {
    core::InputFile exists(options.import);
    const library::PseudonymMap from(
        options.import,
        passphraseFrom(options.otherPassphraseFile, "the map that is taken in", false));
    const std::size_t added = map.add(from.entries());
    map.save();
    context.print(std::to_string(added) +
                  (added == 1 ? " pseudonym is new" : " pseudonyms are new"));
    if (from.key().bytes() != map.key().bytes())
      context.warn("the maps have different keys: new files of these patients get other pseudonyms "
                   "than those that were taken in");
    context.printJson({{"added", added}, {"entries", map.entries().size()}});
  }
  else if (!options.copy.empty())
  {
    if (!map.saveCopy(options.copy, passphraseFrom(options.otherPassphraseFile, "the copy", true)))
      context.warn(options.copy + ": is written, but the disk reported an error; check the disk");
    context.print("the map is copied to " + options.copy);
    context.printJson({{"copy", options.copy}, {"entries", map.entries().size()}});
  }
  else
  {
    map.changePassphrase(passphraseFrom(options.newPassphraseFile, "the map from now on", true));
    context.print("the map has another passphrase");
    context.printJson({{"entries", map.entries().size()}});
  }
}

void pseudonyms(const Context& context, const PseudonymsCommandOptions& options)
{
  const bool changes = options.changePassphrase || !options.newPassphraseFile.empty();
  if (int(changes) + int(!options.import.empty()) + int(!options.copy.empty()) +
          int(!options.find.empty()) >
      1)
    throw UsageError("pseudonyms: one of --find, --import, --export and --change-passphrase");
  if (!options.otherPassphraseFile.empty() && options.import.empty() && options.copy.empty())
    throw UsageError("--other-passphrase-file: give --import or --export, whose file it opens");
  core::InputFile exists(options.map);
  library::PseudonymMap map(options.map, passphraseFor(options.map, options.passphraseFile));
  if (changes || !options.import.empty() || !options.copy.empty())
    return changePseudonyms(context, options, map);
  json list = json::array();
  for (const library::Pseudonym& entry : map.entries())
  {
    if (!contains(entry, options.find))
      continue;
    context.print(entry.kind + " " + entry.pseudonym + ": " + entry.identity);
    list.push_back(
        {{"kind", entry.kind}, {"pseudonym", entry.pseudonym}, {"identity", entry.identity}});
  }
  context.printJson({{"pseudonyms", list}});
}

} // namespace

void addDeidentifyCommands(CLI::App& app, Context& context)
{
  auto options = std::make_shared<DeidentifyCommandOptions>();
  CLI::App* command =
      context.addCommand(app, "deidentify", "De-identify DICOM files by PS3.15, Basic Profile",
                         [options, &context] { deidentify(context, *options); });
  command->add_option("IN", options->input, "A DICOM file, or a folder of any depth")->required();
  command->add_option("OUT", options->output, "The new file, or a new or empty folder")->required();
  command
      ->add_option("--dates", options->dates,
                   "remove; shift by days of each patient's own; or keep them")
      ->check(CLI::IsMember({"remove", "shift", "keep"}))
      ->capture_default_str();
  command->add_flag("--clean-descriptors", options->profile.cleanDescriptors,
                    "Reduce descriptions to a medical vocabulary, instead of removing them");
  command->add_flag("--retain-device", options->profile.retainDevice,
                    "Keep what identifies the device");
  command->add_flag("--retain-patient-characteristics",
                    options->profile.retainPatientCharacteristics,
                    "Keep sex, age, size and weight");
  command->add_flag("--retain-safe-private", options->profile.retainSafePrivate,
                    "Keep the private attributes that PS3.15 lists as safe");
  command->add_flag("--keep-burned-in", options->profile.keepBurnedIn,
                    "Also write images that have, or may have, text in their pixels");
  command->add_flag("--mask-face", options->profile.maskFace,
                    "Put air in place of the face in CT and MR series, and leave out images that "
                    "are in no such volume");
  command->add_option("--map", options->map,
                      "Encrypted file of the pseudonyms, which stays at home; the same map gives "
                      "the same pseudonyms, UIDs and date shifts again");
  command->add_option("--passphrase-file", options->passphraseFile,
                      "File with the map's passphrase in its first line; else it is asked for");
  command->add_flag("--replace", options->replace, "Replace OUT if it is a file that is there");
  command->add_flag("--strict", options->strict,
                    "Exit 3 if a file was left out, for scripts; OUT is there all the same");
  command->add_option("--report", options->report,
                      "What stays and why, and what was removed: F.json or F.txt");

  auto list = std::make_shared<PseudonymsCommandOptions>();
  command = context.addCommand(app, "pseudonyms", "List who is behind the pseudonyms of a map",
                               [list, &context] { pseudonyms(context, *list); });
  command->add_option("MAP", list->map, "The encrypted file")->required();
  command->add_option("--passphrase-file", list->passphraseFile,
                      "File with its passphrase; else it is asked for");
  command->add_option("--find", list->find, "Only those with this text")->type_name("TEXT");
  command->add_option("--import", list->import, "Take in the pseudonyms of another map")
      ->type_name("OTHER");
  command
      ->add_option("--export", list->copy,
                   "Write a copy of the map, encrypted under a passphrase of its own")
      ->type_name("COPY");
  command->add_option("--other-passphrase-file", list->otherPassphraseFile,
                      "File with the passphrase of OTHER or COPY; else it is asked for");
  command->add_flag("--change-passphrase", list->changePassphrase,
                    "Give the map another passphrase, which is asked for");
  command->add_option("--new-passphrase-file", list->newPassphraseFile,
                      "The same, with the new passphrase in the first line of a file");
}

} // namespace petrous::cli
