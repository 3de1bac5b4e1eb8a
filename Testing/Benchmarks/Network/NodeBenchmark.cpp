#include "NodeBenchmark.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/scu.h>
#include <dcmtk/dcmtls/tlsscu.h>

#include "ChildProcess.h"
#include "TestServers.h"
#include "petrous/Imaging/DicomWriter.h"

namespace petrous::network
{

namespace
{

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using imaging::deterministicUid;

const char* const kStudy = "node.study";

double secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<fs::path> writtenSeries(const fs::path& folder, int edge, int slices)
{
  const core::GridGeometry grid({edge, edge, slices}, {0.3, 0.3, 0.3}, Eigen::Vector3d::Zero());
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
  std::uint32_t state = 1;
  for (std::size_t n = 0; n < voxels->size(); ++n)
  {
    state = state * 1664525U + 1013904223U; // noise: nothing on the way may gain by compressing it
    voxels->data()[n] = static_cast<std::int16_t>((state >> 20) % 4096) - 1024;
  }
  imaging::SeriesDescription description;
  description.description = "benchmark";
  description.studyUid = deterministicUid(1, kStudy);
  description.seriesUid = deterministicUid(1, "node.series");
  description.frameOfReferenceUid = deterministicUid(1, "node.frame");
  description.rescaleIntercept = -1024.0;
  imaging::writeDicomSeries(
      folder, volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(voxels)),
      description);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Instance UID -> pixel data.
std::map<std::string, std::vector<Uint16>> pixelsOf(const fs::path& folder)
{
  std::map<std::string, std::vector<Uint16>> pixels;
  std::error_code none;
  for (const auto& entry : fs::recursive_directory_iterator(folder, none))
  {
    DcmFileFormat file;
    OFString uid;
    const Uint16* values = nullptr;
    unsigned long count = 0;
    if (entry.is_regular_file() && file.loadFile(entry.path().c_str()).good() &&
        file.getDataset()->findAndGetOFString(DCM_SOPInstanceUID, uid).good() &&
        file.getDataset()->findAndGetUint16Array(DCM_PixelData, values, &count).good())
      pixels[uid.c_str()].assign(values, values + count);
  }
  return pixels;
}

double percentWrong(const fs::path& sent, const fs::path& arrived)
{
  const auto wanted = pixelsOf(sent);
  const auto found = pixelsOf(arrived);
  std::size_t wrong = 0;
  for (const auto& [uid, values] : wanted)
  {
    const auto other = found.find(uid);
    wrong += other == found.end() || other->second != values ? 1 : 0;
  }
  return 100.0 * static_cast<double>(wrong) / static_cast<double>(wanted.size());
}

double storeByStorescu(const Node& node, const fs::path& folder)
{
  std::vector<std::string> words{"storescu", "-aet",       node.callingAeTitle,
                                 "-aec",     node.aeTitle, "+sd"};
  if (node.tls)
    words.insert(words.end(),
                 {"+tls", node.tls->key, node.tls->certificate, "+cf", node.tls->authority});
  words.insert(words.end(), {node.host, std::to_string(node.port), folder.string()});
  const auto times = registration::runProcess(words);
  return times.status == 0 ? times.seconds : -1.0;
}

/// As its documentation has it, with the storage on disk.
template <class Client>
double getByDcmtk(Client& client, const Node& node, const fs::path& folder)
{
  fs::create_directories(folder);
  const Clock::time_point start = Clock::now();
  client.setAETitle(node.callingAeTitle.c_str());
  client.setPeerAETitle(node.aeTitle.c_str());
  client.setPeerHostName(node.host.c_str());
  client.setPeerPort(static_cast<Uint16>(node.port));
  client.setStorageMode(DCMSCU_STORAGE_DISK);
  client.setStorageDir(folder.c_str());
  OFList<OFString> plain;
  plain.push_back(UID_LittleEndianExplicitTransferSyntax);
  plain.push_back(UID_LittleEndianImplicitTransferSyntax);
  client.addPresentationContext(UID_GETStudyRootQueryRetrieveInformationModel, plain);
  client.addPresentationContext(UID_CTImageStorage, plain, ASC_SC_ROLE_SCP);
  DcmDataset study;
  study.putAndInsertString(DCM_QueryRetrieveLevel, "STUDY");
  study.putAndInsertString(DCM_StudyInstanceUID, deterministicUid(1, kStudy).c_str());
  OFList<RetrieveResponse*> responses;
  bool good = client.initNetwork().good() && client.negotiateAssociation().good();
  good = good && client
                     .sendCGETRequest(client.findPresentationContextID(
                                          UID_GETStudyRootQueryRetrieveInformationModel, ""),
                                      &study, &responses)
                     .good();
  for (RetrieveResponse* response : responses)
    delete response;
  client.releaseAssociation();
  return good ? secondsSince(start) : -1.0;
}

double getByDcmtk(const Node& node, const fs::path& folder)
{
  if (!node.tls)
  {
    DcmSCU client;
    return getByDcmtk(client, node, folder);
  }
  DcmTLSSCU client;
  client.enableAuthentication(node.tls->key.c_str(), node.tls->certificate.c_str(), nullptr,
                              DCF_Filetype_PEM, DCF_Filetype_PEM);
  client.addTrustedCertFile(node.tls->authority.c_str());
  client.setPeerCertVerification(DCV_requireCertificate);
  return getByDcmtk(client, node, folder);
}

/// Seconds of each round and the worst error; a negative time: it failed.
struct Measured
{
  std::vector<double> seconds;
  double error = 0.0;
};

} // namespace

core::BenchmarkReport runNodeBenchmark(const fs::path& workFolder, bool quick,
                                       const core::Progress& progress)
{
  core::BenchmarkReport report;
  report.name = "node";
  report.title = "A CT series to and from a DICOM node (Orthanc, loopback)";
  if (!test::Orthanc::installed())
  {
    report.machine["orthanc"] = "not installed: nothing was measured";
    return report;
  }
  report.machine["orthanc"] = "a process of its own, storage on disk";
  const int slices = quick ? 24 : 512;
  const int edge = quick ? 128 : 512;
  const int rounds = quick ? 1 : 3;
  const fs::path series = workFolder / "series";
  const std::vector<fs::path> files = writtenSeries(series, edge, slices);
  double megabytes = 0.0;
  for (const fs::path& file : files)
    megabytes += static_cast<double>(fs::file_size(file)) / 1e6;
  const test::Certificate server(workFolder, "127.0.0.1");
  const test::Certificate client(workFolder, "client");
  const std::string scene =
      std::to_string(slices) + " slices of " + std::to_string(edge) + "^2, int16";
  int done = 0;
  for (const bool tls : {true, false})
    for (const bool nagle : {false, true})
    {
      std::map<std::pair<std::string, std::string>, Measured> measured; // operation and peer
      ::setenv("TCP_NODELAY", nagle ? "0" : "1", 1);                    // read by DCMTK
      // Minutes each: nothing but waiting is measured with it.
      for (int round = 0; round < (nagle ? 1 : rounds); ++round)
        for (int turn = 0; turn < 2; ++turn)
        {
          const bool peer = (round + turn) % 2 != 0;
          progress.report(std::min(1.0, done++ / (4.0 * rounds + 4.0)), "transferring");
          const fs::path folder = workFolder / "server";
          const fs::path arrived = workFolder / "arrived";
          test::Orthanc::Options options;
          if (tls)
          {
            options.own = &server;
            options.client = &client;
          }
          {
            const test::Orthanc orthanc(folder, options);
            const Node& node = orthanc.node();
            Measured& sent = measured[{"store", peer ? "storescu" : ""}];
            Clock::time_point start = Clock::now();
            if (peer)
              sent.seconds.push_back(storeByStorescu(node, series));
            else
            {
              store(node, files);
              sent.seconds.push_back(secondsSince(start));
            }
            Measured& got = measured[{"get", peer ? "DCMTK's C-GET" : ""}];
            start = Clock::now();
            if (peer)
              got.seconds.push_back(getByDcmtk(node, arrived));
            else
            {
              retrieve(node, deterministicUid(1, kStudy), {}, arrived);
              got.seconds.push_back(secondsSince(start));
            }
            const double wrong = percentWrong(series, arrived);
            sent.error = std::max(sent.error, wrong); // what came back was stored
            got.error = std::max(got.error, wrong);
          }
          fs::remove_all(folder);
          fs::remove_all(arrived);
        }
      for (auto& [what, result] : measured)
      {
        std::sort(result.seconds.begin(), result.seconds.end());
        core::BenchmarkPoint point;
        point.scene = scene;
        point.setting = {{"operation", what.first},
                         {"connection", tls ? "TLS" : "plain"},
                         {"nagle", nagle ? "on" : "off"}};
        point.peer = what.second;
        point.isDefault = what.second.empty() && !nagle;
        point.seconds = result.seconds[result.seconds.size() / 2];
        point.error = result.seconds.front() < 0.0 ? 100.0 : result.error;
        point.errorUnit = "%, instances missing or changed";
        if (point.seconds > 0.0)
          point.extra["mb_per_s"] = megabytes / point.seconds;
        report.points.push_back(std::move(point));
      }
    }
  ::unsetenv("TCP_NODELAY");
  return report;
}

} // namespace petrous::network
