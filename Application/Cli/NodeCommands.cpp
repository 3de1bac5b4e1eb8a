#include <filesystem>
#include <tuple>
#include <utility>

#include "CaseJson.h"
#include "Commands.h"
#include "MaskOptions.h"
#include "Numbers.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Network/NodeList.h"
#include "petrous/Presenters/CaseTransfer.h"

namespace petrous::cli
{

namespace
{

nlohmann::json nodeJson(const network::Node& node)
{
  return {{"name", node.name},
          {"host", node.host},
          {"port", node.port},
          {"ae_title", node.aeTitle},
          {"calling_ae_title", node.callingAeTitle},
          {"tls", node.tls.has_value()}};
}

std::string nodeText(const network::Node& node)
{
  return node.name + "  " + node.aeTitle + " at " + node.host + ":" + std::to_string(node.port) +
         (node.tls ? ", TLS" : "") + ", called as " + node.callingAeTitle;
}

nlohmann::json transferJson(const network::Transfer& transfer)
{
  return {{"instances", transfer.instances}, {"completed", transfer.completed},
          {"present", transfer.present},     {"failed", transfer.instances - transfer.completed},
          {"warning", transfer.warning},     {"asked", transfer.asked},
          {"bytes", transfer.bytes},         {"seconds", transfer.seconds}};
}

std::string transferText(const network::Transfer& transfer)
{
  std::string text = std::to_string(transfer.instances) +
                     (transfer.instances == 1 ? " instance, " : " instances, ") +
                     fixed(1e-6 * static_cast<double>(transfer.bytes), 1) + " MB in " +
                     fixed(transfer.seconds, 1) + " s";
  if (transfer.present > 0)
    text += ", " + std::to_string(transfer.present) + " of them were there already";
  if (transfer.warning > 0)
    text += ", " + std::to_string(transfer.warning) + " with a warning of the node";
  return text;
}

// Paths of keys are kept as they are from everywhere.
std::string absolute(const std::string& path)
{
  return path.empty() ? path : std::filesystem::absolute(path).string();
}

struct NodeOptions
{
  std::string action, name, ca, certificate, key, certifiedName;
  network::Node node;
  bool tls = false;
};

void runNodes(const Context& context, const NodeOptions& options)
{
  const std::string& action = options.action;
  if ((action == "list") != options.name.empty())
    throw UsageError("nodes: give 'nodes list', or 'nodes add|test|remove NAME'");
  network::NodeList list(context.openLibrary().folder());
  if (action == "list")
  {
    nlohmann::json nodes = nlohmann::json::array();
    for (const auto& node : list.nodes())
    {
      context.print(nodeText(node));
      nodes.push_back(nodeJson(node));
    }
    if (nodes.empty())
      context.print("no DICOM node; see 'petrous nodes add --help'");
    context.printJson({{"nodes", std::move(nodes)}});
    return;
  }
  if (action == "remove")
  {
    list.remove(options.name);
    context.print("node '" + options.name + "' is removed");
    context.printJson({{"removed", options.name}});
    return;
  }
  if (action == "test")
  {
    const network::Node& node = list.at(options.name);
    const auto start = std::chrono::steady_clock::now();
    network::echo(node, context.progress());
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    context.print(nodeText(node) + ": answers, " + fixed(1e3 * seconds, 0) + " ms");
    nlohmann::json answer = nodeJson(node);
    answer["seconds"] = seconds;
    context.printJson(answer);
    return;
  }
  network::Node node = options.node;
  node.name = options.name;
  if (node.host.empty() || node.aeTitle.empty())
    throw UsageError("nodes add: give --host, --port and --aet");
  for (const auto& [option, port, least] :
       {std::tuple("--port", node.port, 1), std::tuple("--move-port", node.movePort, 0)})
    if (port < least || port > 65535)
      throw UsageError("nodes add: " + std::string(option) + " must lie within 1 to 65535, not " +
                       std::to_string(port));
  for (const auto& [option, title] :
       {std::pair("--aet", &node.aeTitle), std::pair("--calling", &node.callingAeTitle)})
    if (title->size() > 16)
      throw UsageError("nodes add: " + std::string(option) +
                       ": an AE title has 16 characters at most, not " +
                       std::to_string(title->size()));
  if (options.tls || !options.ca.empty() || !options.certificate.empty() || !options.key.empty() ||
      !options.certifiedName.empty())
    node.tls = network::TlsFiles{absolute(options.ca), absolute(options.certificate),
                                 absolute(options.key), options.certifiedName};
  network::checkNode(node);
  network::checkTlsFiles(node);
  list.add(node);
  context.print(nodeText(node) + ": is added; 'petrous nodes test " + node.name + "' calls it");
  context.printJson(nodeJson(node));
}

struct SendOptions
{
  std::string caseName, node, what = "all";
  MaskOptions mask;
  bool withoutNotes = false, withVideos = false, withDocuments = false, dryRun = false;
  bool isUnverified = false;
};

void send(const Context& context, const SendOptions& options)
{
  const library::Library library = context.openLibrary();
  const network::NodeList list(library.folder());
  const network::Node& node = list.at(options.node);
  const bool all = options.what == "all";
  presenters::SendParts parts;
  parts.ct = all || options.what == "ct";
  parts.mr = all || options.what == "mr";
  parts.labels = all || options.what == "labels";
  parts.scene = all || options.what == "scene";
  parts.mask = options.mask.mask();
  parts.note = !options.withoutNotes;
  parts.videos = options.withVideos;
  parts.documents = options.withDocuments;
  const presenters::IdentityReport report =
      presenters::identityReport(library.open(options.caseName), parts, nullptr, &library);
  if (options.dryRun)
    return printIdentityReport(context, report);
  for (const std::string& warning : report.warnings) // before anything leaves
    context.warn(warning);
  for (const std::string& names : report.counted)
    context.warn("  " + names);
  const auto done =
      presenters::sendCase(library, options.caseName, node, parts, context.progress());
  for (const std::string& note : done.notes)
    context.warn(note);
  if (done.transfer.listed == network::Transfer::Listed::None && !options.isUnverified)
    throw network::NetworkError(network::NetworkError::Reason::Incomplete,
                                "node '" + options.node +
                                    "': confirmed every instance, but lists none of them; look "
                                    "there whether it has them, or give --unverified for a node "
                                    "that does not list what it keeps");
  if (const std::string why = presenters::unlistedText(done.transfer); !why.empty())
    context.warn("node '" + options.node + "' confirmed every instance, but " + why +
                 ", so they could not be counted there");
  context.print("case '" + options.caseName + "' is at node '" + options.node +
                "': " + transferText(done.transfer));
  context.print("patient '" + done.patient.name + "', ID " + done.patient.id + ", study " +
                done.studyUid +
                (!parts.scene ? std::string()
                              : "; to bring it back: petrous receive --from " + options.node +
                                    " --case \"" + options.caseName + '"' +
                                    (done.patient.isNameHidden()
                                         ? ", from another library --study " + done.studyUid
                                         : std::string())));
  nlohmann::json answer = transferJson(done.transfer);
  answer["case"] = options.caseName;
  answer["node"] = options.node;
  answer["study"] = done.studyUid;
  answer["patient_id"] = done.patient.id;
  answer["patient_name"] = done.patient.name;
  answer["verified"] = done.transfer.verified;
  answer["notes"] = done.notes;
  context.printJson(answer);
}

struct ReceiveOptions
{
  std::string node;
  presenters::ReceiveRequest request;
  std::string volume, bits, partial;
  bool isList = false;
};

void listCases(const Context& context, const ReceiveOptions& options)
{
  const library::Library library = context.openLibrary();
  presenters::StudySearch search;
  search.caseName = options.request.caseName;
  nlohmann::json cases = nlohmann::json::array();
  const auto found = presenters::searchStudies(network::NodeList(library.folder()).at(options.node),
                                               search, library, context.progress());
  for (const std::string& note : found.notes)
    context.warn(core::printable(note));
  for (const auto& one : found.studies)
  {
    const network::Study& study = one.study;
    context.print(
        (one.caseName.empty() ? "(name not told)" : "'" + core::printable(one.caseName) + "'") +
        (one.otherName.empty() ? ""
                               : ", there of patient '" + core::printable(one.otherName) + "'") +
        ", patient ID " + core::printable(study.patientId) + ", study " +
        core::printable(study.uid) +
        (study.modalities.empty() ? "" : ", " + core::printable(study.modalities)) +
        (study.instances < 0 ? "" : ", " + std::to_string(study.instances) + " instances"));
    nlohmann::json listed = {
        {"patient_id", study.patientId},
        {"study", study.uid},
        {"modalities", study.modalities},
        {"instances", study.instances < 0 ? nlohmann::json() : nlohmann::json(study.instances)}};
    listed["case"] = one.caseName.empty() ? nlohmann::json() : nlohmann::json(one.caseName);
    if (!one.otherName.empty())
      listed["patient_name"] = one.otherName;
    cases.push_back(std::move(listed));
  }
  if (cases.empty())
    context.print("node '" + options.node + "' has no such case of Petrous");
  context.printJson({{"node", options.node}, {"cases", std::move(cases)}});
}

void receive(const Context& context, const ReceiveOptions& options)
{
  presenters::ReceiveRequest request = options.request;
  request.partial = options.partial;
  request.undeclaredBits = undeclaredBitsOf(options.bits);
  if (options.isList)
  {
    if (!request.studyUid.empty() || !request.as.empty() || !request.series.empty() ||
        request.repair || !options.bits.empty() || !options.partial.empty())
      throw UsageError("receive: --list goes with --from and --case alone");
    return listCases(context, options);
  }
  if (!options.volume.empty())
    request.series += "#" + options.volume;
  if (request.studyUid.empty() == request.caseName.empty())
    throw UsageError("receive: give --study UID or --case NAME, or --list");
  library::Library library = context.openLibrary();
  const network::NodeList list(library.folder());
  const auto done =
      presenters::receiveCase(library, list.at(options.node), request, context.progress());
  for (const std::string& note : done.notes)
    context.warn(note);
  context.print("case '" + done.name + "' is " +
                (done.scene ? "restored from its scene: " : "built of the study: ") +
                transferText(done.transfer));
  nlohmann::json answer = transferJson(done.transfer);
  answer["case"] = done.name;
  answer["node"] = options.node;
  answer["scene"] = done.scene;
  answer["notes"] = done.notes;
  context.printJson(answer);
}

} // namespace

void addNodeCommands(CLI::App& app, Context& context)
{
  auto nodes = std::make_shared<NodeOptions>();
  CLI::App* command =
      context.addCommand(app, "nodes", "DICOM nodes that cases are sent to and received from",
                         [nodes, &context] { runNodes(context, *nodes); });
  command->add_option("ACTION", nodes->action, "add, list, test or remove")
      ->check(oneOf({"add", "list", "test", "remove"}))
      ->required();
  command->add_option("NAME", nodes->name, "Your name for the node");
  command->add_option("--host", nodes->node.host, "Name or address")->type_name("H");
  command->add_option("--port", nodes->node.port, "Its DICOM port")->capture_default_str();
  command->add_option("--aet", nodes->node.aeTitle, "Its AE title")->type_name("A");
  command
      ->add_option("--calling", nodes->node.callingAeTitle,
                   "AE title by which the node knows this program")
      ->type_name("C")
      ->capture_default_str();
  command
      ->add_option("--move-port", nodes->node.movePort,
                   "Port at which this program listens for a node that offers C-MOVE only; the "
                   "node must know this program's AE title at this host and port")
      ->type_name("P");
  command
      ->add_option("--move-host", nodes->node.moveHost,
                   "Host from which the node then sends, where it is not --host; '*': any")
      ->type_name("H");
  command->add_flag("--tls", nodes->tls,
                    "TLS 1.2 or later; implied by the options below. The node's certificate is "
                    "always verified, and must be of the host");
  command->add_option("--tls-ca", nodes->ca, "Certificates to trust (PEM), instead of the system's")
      ->type_name("F");
  command->add_option("--tls-cert", nodes->certificate, "Certificate of this program (PEM)")
      ->type_name("F");
  command->add_option("--tls-key", nodes->key, "Its key (PEM, without a passphrase)")
      ->type_name("F");
  command
      ->add_option("--tls-name", nodes->certifiedName,
                   "Name or address in the node's certificate, where it is not the host; '*': any "
                   "certificate of --tls-ca will do")
      ->type_name("H");

  auto out = std::make_shared<SendOptions>();
  command = context.addCommand(app, "send", "Send a case to a DICOM node",
                               [out, &context] { send(context, *out); });
  command->add_option("CASE", out->caseName, "Name of the case")->required();
  command->add_option("--to,--node", out->node, "See 'petrous nodes'")
      ->type_name("NODE")
      ->required();
  command
      ->add_option("--what", out->what,
                   "ct and mr as series, labels as a segmentation, scene: all of the case, to be "
                   "received as it is")
      ->check(oneOf({"ct", "mr", "labels", "scene", "all"}))
      ->capture_default_str();
  command->add_flag("--with-videos", out->withVideos,
                    "Attached videos go along with the scene; they may show or name the patient");
  command->add_flag("--with-documents", out->withDocuments,
                    "Attached PDFs too; they may name the patient, also in their metadata, which "
                    "is not removed");
  command->add_flag("--without-notes", out->withoutNotes,
                    "Leave out the note of the description, which else goes along as it is");
  command->add_flag("--unverified", out->isUnverified,
                    "Believe a node that lists nothing of what it confirmed");
  command->add_flag("--dry-run", out->dryRun,
                    "Only say what of the case would leave, and what may identify the patient; "
                    "nothing is sent");
  addMaskOptions(*command, out->mask);

  auto in = std::make_shared<ReceiveOptions>();
  command = context.addCommand(app, "receive", "Add a case from a DICOM node to the library",
                               [in, &context] { receive(context, *in); });
  command->add_option("--from,--node", in->node, "See 'petrous nodes'")
      ->type_name("NODE")
      ->required();
  command->add_option("--study", in->request.studyUid, "Study Instance UID")->type_name("UID");
  command->add_option("--case", in->request.caseName, "The case that was sent with its scene")
      ->type_name("NAME");
  command->add_flag("--list", in->isList,
                    "Only list the cases of Petrous that the node has; with --case those with "
                    "this in their names");
  command->add_option("--as", in->request.as, "Name of the new case");
  command
      ->add_option("--series", in->request.series,
                   "The CT series to build a case of, also where the study has a scene")
      ->type_name("UID");
  command
      ->add_option("--volume", in->volume,
                   "Which volume of a CT series with several, as the refusal names it")
      ->type_name("NAME");
  command->add_flag("--repair", in->request.repair,
                    "Resample tilted, uneven or gapped slices to a straight volume");
  command
      ->add_option("--bits", in->bits,
                   "Of DICOM pixels with bits beside those stored that nothing explains: stored "
                   "leaves these out, allocated keeps them (else they are refused)")
      ->check(oneOf({"stored", "allocated"}));
  command
      ->add_option("--partial", in->partial,
                   "Keeps what arrives in this folder, and goes on from what is there")
      ->type_name("FOLDER");
}

} // namespace petrous::cli
